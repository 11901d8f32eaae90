// octoblisk make: writes a generated blisk, or a part of the belt grinder, to a mesh file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "command_line/help.h"
#include "command_line/options.h"
#include "commands/commands.h"
#include "grinding/tool_file.h"
#include "io/mesh_file.h"
#include "io/whole_files.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"
#include "models/length_limit.h"

namespace octoblisk::demos {
namespace {

void writeAndReport(const std::string& file, const TriangleMesh& mesh) {
  writeMesh(file, mesh);
  const Vec3 size = 2.0 * mesh.bounds().halfExtents();
  std::cout << file << ": " << mesh.triangleCount() << " triangles, " << std::setprecision(6) << size.x()
            << " x " << size.y() << " x " << size.z() << " mm\n";
}

constexpr const char* kOutHelp = "File to write: .stl (binary), .obj or .ply (binary)";

/// Any length or angle; the generators report sizes that they cannot use.
CLI::Validator size() { return numberFrom(-kMaxLength, kMaxLength); }

struct BliskRequest {
  std::string out;
  std::string sections;
  std::string hub_profile;
  double length = 200.0;  // mm
  BladeParameters blade;
  BliskOptions blisk;
  std::vector<const CLI::Option*> parametric;  ///< the options that files replace
};

void makeBliskFile(const BliskRequest& request) {
  if (request.sections.empty() != request.hub_profile.empty()) {
    throw std::invalid_argument("--sections and --hub-profile: give both or neither");
  }
  const bool from_files = !request.sections.empty();
  for (const CLI::Option* option : request.parametric) {
    if (from_files && option->count() > 0) {
      throw std::invalid_argument(option->get_name() +
                                  " belongs to the parametric blade: it cannot be used with --sections");
    }
  }
  const BladeSections sections =
      from_files ? readBladeSections(request.sections) : makeBladeSections(request.blade);
  const RadiusProfile hub = from_files ? readHubProfile(request.hub_profile)
                                       : cylinderProfile(request.blade.hub_radius, 0.5 * request.length);
  writeAndReport(request.out, makeBlisk(sections, hub, request.blisk).mesh);
}

void addBlisk(CLI::App& make) {
  CLI::App& command = *make.add_subcommand("blisk", "A bladed disk as one closed surface about the Z axis");
  const auto request = std::make_shared<BliskRequest>();
  BladeParameters& blade = request->blade;
  BliskOptions& blisk = request->blisk;
  addOut(command, request->out, kOutHelp);

  const auto addOfDisk = [&](const std::string& name, auto& value, const std::string& placeholder,
                             const CLI::Validator& check, const std::string& help) {
    return addOption(command, name, value, placeholder, check, help)->group("Disk");
  };
  addOfDisk("--triangles", blisk.target_triangles, "N", wholeNumberFrom(1, 10'000'000),
            "Number of triangles wanted, up to 10 million; met within 15 %");
  addOfDisk("--blades", blisk.blade_count, "N", wholeNumberFrom(2, 10'000), "Number of blades");
  addOfDisk("--bore-radius", blisk.bore_radius, "MM", size(), "Radius of the bore");
  CLI::Option* const shroud =
      command.add_flag("--shroud", blisk.shroud, "Join the blade tips with a ring")->group("Disk");
  addOfDisk("--shroud-thickness", blisk.shroud_thickness, "MM", size(), "Radial thickness of the shroud")
      ->needs(shroud);
  addOfDisk("--shroud-overhang", blisk.shroud_overhang, "MM", size(),
            "Axial overhang of the shroud beyond the tips")
      ->needs(shroud);

  const std::string files = "Blade and hub from files";
  addFile(command, "--sections", request->sections,
          "Folder of blade sections, one CSV file each (x,y,z in mm); sorted by name, they run from "
          "hub to tip",
          "DIR")
      ->group(files);
  addFile(command, "--hub-profile", request->hub_profile, "Profile of the hub, a CSV file (z,r in mm)")
      ->group(files);

  const auto addOfBlade = [&](const std::string& name, auto& value, const std::string& placeholder,
                              const CLI::Validator& check, const std::string& help) {
    CLI::Option* const option = addOption(command, name, value, placeholder, check, help);
    request->parametric.push_back(option->group("Parametric blade and hub"));
  };
  const auto addLength = [&](const std::string& name, double& value, const std::string& help) {
    addOfBlade(name, value, "MM", size(), help);
  };
  const auto addAngle = [&](const std::string& name, double& value, const std::string& help) {
    addOfBlade(name, value, "DEG", size(), help);
  };
  addLength("--length", request->length, "Length of the hub along Z");
  addLength("--hub-radius", blade.hub_radius, "Radius of the hub");
  addLength("--tip-radius", blade.tip_radius, "Radius of the blade tips");
  addLength("--chord-hub", blade.chord_hub, "Chord at the hub");
  addLength("--chord-tip", blade.chord_tip, "Chord at the tip");
  addAngle("--stagger-hub", blade.stagger_hub, "Angle from the axis to the chord at the hub");
  addAngle("--stagger-tip", blade.stagger_tip, "Angle from the axis to the chord at the tip");
  addLength("--thickness-hub", blade.thickness_hub, "Thickness of the blade at the hub");
  addLength("--thickness-tip", blade.thickness_tip, "Thickness of the blade at the tip");
  addLength("--camber-hub", blade.camber_hub, "Rise of the camber line at the hub");
  addLength("--camber-tip", blade.camber_tip, "Rise of the camber line at the tip");
  addLength("--edge-radius", blade.edge_radius, "Radius of the leading and trailing edges");
  addAngle("--lean", blade.lean, "Angle about Z by which the tip leads the hub");
  addOfBlade("--section-count", blade.section_count, "N", wholeNumberFrom(2, 1000),
             "Number of sections from hub to tip");

  command.callback([request] { makeBliskFile(*request); });
}

struct GrinderRequest {
  std::string out;
  BeltParameters belt;
};

/// Every part takes all sizes of the grinder, so that parts made with the same sizes fit together.
void addSizes(CLI::App& command, BeltParameters& belt) {
  const auto addSize = [&](const std::string& name, auto& value, const std::string& placeholder,
                           const CLI::Validator& check, const std::string& help) {
    addOption(command, name, value, placeholder, check, help)->group("Belt grinder (sizes are assumed)");
  };
  const auto addLength = [&](const std::string& name, double& value, const std::string& help) {
    addSize(name, value, "MM", size(), help);
  };
  addLength("--width", belt.width, "Width of the belt");
  addLength("--thickness", belt.thickness, "Thickness of the belt");
  addLength("--abrasive", belt.abrasive, "Thickness of the belt's contact side, a part of --thickness");
  addLength("--contact-wheel-radius", belt.contact_wheel_radius,
            "Radius of the belt's inner surface at the contact wheel");
  addLength("--drive-wheel-radius", belt.drive_wheel_radius,
            "Radius of the belt's inner surface at the drive wheel");
  addLength("--wheel-distance", belt.wheel_distance, "Distance between the wheels' centres");
  addLength("--wheel-gap", belt.wheel_gap, "Gap between wheel and belt");
  addSize("--stations", belt.stations, "N", wholeNumberFrom(16, 100'000),
          "Number of stations along the belt");
  addSize("--points-per-station", belt.points_per_station, "N", wholeNumberFrom(4, 100'000),
          "Number of points around the belt's cross-section");
  addLength("--arm-start", belt.arm_start, "Distance of the arm's start from the contact wheel's centre");
  addLength("--arm-width", belt.arm_width, "Width of the arm along the wheels' axes");
  addLength("--arm-height", belt.arm_height, "Height of the arm between the strands");
}

void addGrinderPart(CLI::App& make, const std::string& name, const std::string& description,
                    TriangleMesh (*makePart)(const BeltParameters&)) {
  CLI::App& command = *make.add_subcommand(name, description);
  const auto request = std::make_shared<GrinderRequest>();
  addOut(command, request->out, kOutHelp);
  addSizes(command, request->belt);
  command.callback([request, makePart] { writeAndReport(request->out, makePart(request->belt)); });
}

/// Writes all parts and the tool file for 'octoblisk grind --tool'.
void makeGrinderFiles(const GrinderRequest& request) {
  constexpr double kOfBelt = 0.5, kOfOthers = 1.0, kOfBackAtWork = 0.2;  // near misses, mm: assumed
  const std::pair<const char*, TriangleMesh (*)(const BeltParameters&)> parts[] = {
      {"belt contact side", makeBeltContactSide},
      {"belt back", makeBeltBack},
      {"contact wheel", makeContactWheel},
      {"drive wheel", makeDriveWheel},
      {"arm", makeArm}};
  std::vector<TriangleMesh> meshes;  // all made before any is written, because sizes may be refused
  for (const auto& [name, makePart] : parts) meshes.push_back(makePart(request.belt));

  const std::filesystem::path out = request.out;
  makeFolder(out);
  ToolFile tool;
  WholeFiles files;
  for (std::size_t part = 0; part < meshes.size(); ++part) {
    std::string file = parts[part].first;
    std::ranges::replace(file, ' ', '_');
    file += ".ply";
    writeMesh(files.add(out / file), meshes[part]);
    tool.parts.push_back({parts[part].first, file, {}});
  }
  tool.parts.front().max_depth = 0.1;
  tool.allowed = {{std::size_t{0}, {BladeChoice::Kind::ground, 0}}};
  tool.margins = {{std::nullopt, {BladeChoice::Kind::any, 0}, kOfOthers},
                  {std::size_t{0}, {BladeChoice::Kind::any, 0}, kOfBelt},
                  {std::size_t{1}, {BladeChoice::Kind::any, 0}, kOfBelt},
                  {std::size_t{1}, {BladeChoice::Kind::ground, 0}, kOfBackAtWork}};
  writeToolFile(files.add(out / "tool.json"), tool);
  files.finish();
  std::cout << (out / "tool.json").string() << ": " << tool.parts.size()
            << " parts, with their meshes beside it\n";
}

void addGrinder(CLI::App& make) {
  CLI::App& command = *make.add_subcommand(
      "grinder", "The whole grinder: one mesh per part, and a tool.json for 'octoblisk grind --tool'");
  const auto request = std::make_shared<GrinderRequest>();
  addOut(command, request->out, "Folder to write to; created if missing", "DIR");
  addSizes(command, request->belt);
  command.callback([request] { makeGrinderFiles(*request); });
}

}  // namespace

void addMakeCommand(CLI::App& app, int&) {
  CLI::App& make = addSubcommand(app, "make");
  make.require_subcommand(1);
  addBlisk(make);
  addGrinder(make);
  addGrinderPart(make, "belt", "The abrasive belt: contact wheel at the origin, arm along +x", makeBelt);
  addGrinderPart(make, "contact-wheel", "The small wheel, at the origin, its axis along z", makeContactWheel);
  addGrinderPart(make, "drive-wheel", "The large wheel at the far end of the arm", makeDriveWheel);
  addGrinderPart(make, "arm", "The bar between the wheels", makeArm);
}

}  // namespace octoblisk::demos
