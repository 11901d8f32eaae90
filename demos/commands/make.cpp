// octoblisk make: writes a generated blisk or a part of the belt grinder to a mesh file.
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

#include "command_line/option_checks.h"
#include "command_line/out_folder.h"
#include "command_line/subcommand_help.h"
#include "commands/commands.h"
#include "grinding/tool_file.h"
#include "io/mesh_file.h"
#include "io/whole_files.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"
#include "models/length_limit.h"

namespace octoblisk::demos {
namespace {

void writeAndTell(const std::string& file, const TriangleMesh& mesh) {
  writeMesh(file, mesh);
  const Vec3 size = 2.0 * mesh.bounds().halfExtents();
  std::cout << file << ": " << mesh.triangleCount() << " triangles, " << std::setprecision(6) << size.x()
            << " x " << size.y() << " x " << size.z() << " mm\n";
}

void addOut(CLI::App& command, std::string& out) {
  command.add_option("-o,--out", out, "File to write: .stl (binary), .obj or .ply (binary)")
      ->required()
      ->check(notEmpty());
}

/// Any length or angle; the generators tell what they make of it.
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
    throw std::invalid_argument("--sections and --hub-profile go together: give both, or neither");
  }
  const bool from_files = !request.sections.empty();
  for (const CLI::Option* option : request.parametric) {
    if (from_files && option->count() > 0) {
      throw std::invalid_argument(option->get_name() +
                                  " is of the parametric blade: it cannot go with --sections");
    }
  }
  const BladeSections sections =
      from_files ? readBladeSections(request.sections) : makeBladeSections(request.blade);
  const RadiusProfile hub = from_files ? readHubProfile(request.hub_profile)
                                       : cylinderProfile(request.blade.hub_radius, 0.5 * request.length);
  writeAndTell(request.out, makeBlisk(sections, hub, request.blisk).mesh);
}

void addBlisk(CLI::App& make) {
  CLI::App& command = *make.add_subcommand("blisk", "A bladed disk as one closed surface, axis Z");
  const auto request = std::make_shared<BliskRequest>();
  BladeParameters& blade = request->blade;
  BliskOptions& blisk = request->blisk;
  addOut(command, request->out);

  const std::string disk = "Disk";
  command
      .add_option("--triangles", blisk.target_triangles,
                  "Triangles wanted, up to 10 million, met within 15 %")
      ->check(wholeNumberFrom(1, 10'000'000))
      ->group(disk);
  command.add_option("--blades", blisk.blade_count, "Number of blades")
      ->check(wholeNumberFrom(2, 10'000))
      ->group(disk);
  command.add_option("--bore-radius", blisk.bore_radius, "mm")->check(size())->group(disk);
  CLI::Option* const shroud =
      command.add_flag("--shroud", blisk.shroud, "Join the tips by a ring")->group(disk);
  command.add_option("--shroud-thickness", blisk.shroud_thickness, "mm, radially")
      ->check(size())
      ->needs(shroud)
      ->group(disk);
  command.add_option("--shroud-overhang", blisk.shroud_overhang, "mm, axially beyond the tips")
      ->check(size())
      ->needs(shroud)
      ->group(disk);

  const std::string files = "Blade and hub from files";
  command
      .add_option("--sections", request->sections,
                  "Folder of blade sections, one CSV file each (x,y,z in mm), hub to tip by name")
      ->check(notEmpty())
      ->group(files);
  command.add_option("--hub-profile", request->hub_profile, "Hub surface, CSV file (z,r in mm)")
      ->check(notEmpty())
      ->group(files);

  const auto addOption = [&](const std::string& name, auto& value, const std::string& help) {
    CLI::Option* const option = command.add_option(name, value, help)->group("Parametric blade and hub");
    request->parametric.push_back(option);
    return option;
  };
  const auto addParameter = [&](const std::string& name, double& value, const std::string& help) {
    addOption(name, value, help)->check(size());
  };
  addParameter("--length", request->length, "mm, of the hub along Z");
  addParameter("--hub-radius", blade.hub_radius, "mm");
  addParameter("--tip-radius", blade.tip_radius, "mm");
  addParameter("--chord-hub", blade.chord_hub, "mm");
  addParameter("--chord-tip", blade.chord_tip, "mm");
  addParameter("--stagger-hub", blade.stagger_hub, "Degrees from the axis to the chord");
  addParameter("--stagger-tip", blade.stagger_tip, "Degrees from the axis to the chord");
  addParameter("--thickness-hub", blade.thickness_hub, "mm");
  addParameter("--thickness-tip", blade.thickness_tip, "mm");
  addParameter("--camber-hub", blade.camber_hub, "mm, rise of the camber line");
  addParameter("--camber-tip", blade.camber_tip, "mm, rise of the camber line");
  addParameter("--edge-radius", blade.edge_radius, "mm, of leading and trailing edge");
  addParameter("--lean", blade.lean, "Degrees about Z by which the tip leads the hub");
  addOption("--section-count", blade.section_count, "Number of sections from hub to tip")
      ->check(wholeNumberFrom(2, 1000));

  command.callback([request] { makeBliskFile(*request); });
}

struct GrinderRequest {
  std::string out;
  BeltParameters belt;
};

/// Every part takes the whole grinder's sizes, so that the parts made with the same ones fit together.
void addSizes(CLI::App& command, BeltParameters& belt) {
  const auto addOption = [&](const std::string& option, auto& value, const std::string& help) {
    return command.add_option(option, value, help)->group("Belt grinder (sizes are assumed)");
  };
  const auto addParameter = [&](const std::string& option, double& value, const std::string& help) {
    addOption(option, value, help)->check(size());
  };
  addParameter("--width", belt.width, "mm, of the belt");
  addParameter("--thickness", belt.thickness, "mm, of the belt");
  addParameter("--abrasive", belt.abrasive, "mm of the belt's thickness that are its contact side");
  addParameter("--contact-wheel-radius", belt.contact_wheel_radius, "mm, of the belt's inner surface there");
  addParameter("--drive-wheel-radius", belt.drive_wheel_radius, "mm, of the belt's inner surface there");
  addParameter("--wheel-distance", belt.wheel_distance, "mm, between the wheels' centres");
  addParameter("--wheel-gap", belt.wheel_gap, "mm, from wheel to belt");
  addOption("--stations", belt.stations, "Stations round the belt")->check(wholeNumberFrom(16, 100'000));
  addOption("--points-per-station", belt.points_per_station, "Points round the belt's cross-section")
      ->check(wholeNumberFrom(4, 100'000));
  addParameter("--arm-start", belt.arm_start, "mm, from the contact wheel's centre");
  addParameter("--arm-width", belt.arm_width, "mm, along the wheels' axes");
  addParameter("--arm-height", belt.arm_height, "mm, between the strands");
}

void addGrinderPart(CLI::App& make, const std::string& name, const std::string& description,
                    TriangleMesh (*makePart)(const BeltParameters&)) {
  CLI::App& command = *make.add_subcommand(name, description);
  const auto request = std::make_shared<GrinderRequest>();
  addOut(command, request->out);
  addSizes(command, request->belt);
  command.callback([request, makePart] { writeAndTell(request->out, makePart(request->belt)); });
}

/// All parts, and the file for 'octoblisk grind --tool'.
void makeGrinderFiles(const GrinderRequest& request) {
  constexpr double kOfBelt = 0.5, kOfOthers = 1.0, kOfBackAtWork = 0.2;  // near misses, mm: assumed
  const std::pair<const char*, TriangleMesh (*)(const BeltParameters&)> parts[] = {
      {"belt contact side", makeBeltContactSide},
      {"belt back", makeBeltBack},
      {"contact wheel", makeContactWheel},
      {"drive wheel", makeDriveWheel},
      {"arm", makeArm}};
  std::vector<TriangleMesh> meshes;  // before any is written: sizes may be refused
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
  std::cout << (out / "tool.json").string() << ": " << tool.parts.size() << " parts, meshes beside it\n";
}

void addGrinder(CLI::App& make) {
  CLI::App& command = *make.add_subcommand(
      "grinder", "The whole grinder: a mesh a part, and the tool.json of 'octoblisk grind --tool'");
  const auto request = std::make_shared<GrinderRequest>();
  command.add_option("-o,--out", request->out, "Folder; made where missing")->required()->check(notEmpty());
  addSizes(command, request->belt);
  command.callback([request] { makeGrinderFiles(*request); });
}

}  // namespace

void addMakeCommand(CLI::App& app, int&) {
  CLI::App& make = addSubcommand(app, "make");
  make.require_subcommand(1);
  make.option_defaults()->always_capture_default();
  addBlisk(make);
  addGrinder(make);
  addGrinderPart(make, "belt", "The abrasive belt: contact wheel at the origin, arm along +x", makeBelt);
  addGrinderPart(make, "contact-wheel", "The small wheel at the origin, axis z", makeContactWheel);
  addGrinderPart(make, "drive-wheel", "The great wheel at the arm's far end", makeDriveWheel);
  addGrinderPart(make, "arm", "The bar between the wheels", makeArm);
}

}  // namespace octoblisk::demos
