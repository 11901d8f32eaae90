// octoblisk path: writes a toolpath along a blade.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "command_line/blisk_options.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/units_option.h"
#include "commands/commands.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "models/blade_anatomy.h"
#include "models/blisk_axis.h"
#include "models/embedded_assets.h"
#include "models/length_limit.h"
#include "toolpath/cl_motions.h"
#include "toolpath/pose_file.h"
#include "toolpath/surface_path.h"

namespace octoblisk::demos {
namespace {

struct PathRequest {
  std::string blisk, axis, convex, units;  // empty: the built-in blisk, found, found, mm
  int blade = 1;
  std::string side = "convex";
  std::string pattern = "transversal";
  std::string arm;  // empty: see armAsked
  std::string format = "csv";
  double wheel_width = BeltParameters{}.width;  // mm
  std::string out;
  SurfacePathOptions options;
};

/// The arm cannot leave through a shroud: by default it then leaves the leading edge upstream, and everything
/// else downstream.
PathArm armAsked(const PathRequest& request, bool shrouded) {
  if (request.arm == "upstream") return PathArm::upstream;
  if (request.arm == "downstream") return PathArm::downstream;
  if (request.arm == "outward" || !shrouded) return PathArm::outward;
  return request.side == "leading" ? PathArm::upstream : PathArm::downstream;
}

void requireWheelFits(const std::string& blisk, double blisk_size, double wheel) {
  constexpr double kGreatestRatio = 300.0;
  requireSizesFit(blisk, blisk_size, "contact wheel", wheel, kGreatestRatio, "--wheel-radius in");
}

int makePath(PathRequest request) {
  const std::string name = request.blisk.empty() ? "the built-in blisk" : request.blisk;
  std::error_code ignored;  // usually the file does not exist
  if (std::filesystem::equivalent(request.out, request.blisk, ignored)) {
    throw std::runtime_error(request.out + ": is also an input file: choose another --out");
  }
  const TriangleMesh mesh =
      request.blisk.empty() ? embeddedBlisk() : readUsersMesh(request.blisk, request.units);
  if (request.units != "mm") requireWheelFits(name, sizeOf(mesh), 2.0 * request.options.wheel_radius);
  const BliskFound found = bliskAbout(request.axis, mesh, name);
  if (request.blade > found.blades.count) {
    throw std::invalid_argument("--blade " + std::to_string(request.blade) + ": " + name + " has " +
                                std::to_string(found.blades.count) + " blades, numbered from 1");
  }
  const TriangleMesh blisk = moved(mesh, found.mesh_in_blisk);
  const BliskAnatomy anatomy = anatomyOf(blisk, found.blades, name);
  SurfacePathOptions& options = request.options;
  options.region = regionNamed(request.side, request.convex, anatomy, name);
  options.pattern = request.pattern == "longitudinal" ? PathPattern::longitudinal : PathPattern::transversal;
  options.arm = armAsked(request, found.blades.shrouded);
  const WheelSeat seat(blisk, anatomy.sides.blade_of_triangle, request.blade, options.wheel_radius,
                       request.wheel_width);
  SurfacePath path = makeSurfacePath(BladeContours(blisk, anatomy.sides, request.blade), options, &seat);

  const Pose blisk_in_mesh = found.mesh_in_blisk.inverse();
  for (ToolMotion& motion : path.motions) motion.tool_in_blisk = blisk_in_mesh * motion.tool_in_blisk;
  WholeFiles whole;
  const std::filesystem::path written = whole.add(request.out);
  if (request.format == "apt") {
    writeClFile(written, path.motions);
  } else {
    writeMotions(written, path.motions);
  }
  whole.finish();
  const int passes = *std::ranges::max_element(path.pass_of_motion) + 1;
  std::ostream& words = isStandardOutput(request.out) ? std::cerr : std::cout;
  words << request.out << ": " << path.motions.size() << " poses, " << passes << ' ' << request.pattern
        << (passes == 1 ? " pass " : " passes ")
        << (isEdge(options.region) ? "around the " + request.side + " edge"
                                   : "on the " + request.side + " side")
        << " of blade " << request.blade << " of " << found.blades.count << ", at most " << options.step_over
        << " mm apart, from " << options.height_from << " to " << options.height_to << " of its height\n";
  return 0;
}

}  // namespace

void addPathCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "path");
  const auto request = std::make_shared<PathRequest>();
  SurfacePathOptions& options = request->options;
  addBliskOptions(command, request->blisk, request->axis);
  addUnitsOption(command, request->units);
  addConvexOption(command, request->convex);
  addChoice(command, "--arm", request->arm, {"outward", "upstream", "downstream"},
            "Direction in which the arm leaves the blades: outward, away from the axis; upstream or "
            "downstream, through the end of the channel. Default: outward; on a shrouded blisk, "
            "downstream, or upstream around the leading edge");
  addOption(command, "--blade", request->blade, "N", wholeNumberFrom(1, 10'000),
            "Number of the blade, from 1, as in the table of 'octoblisk blades'");
  addChoice(command, "--side", request->side, {"convex", "concave", "leading", "trailing"},
            "Surface to grind: the convex side, the concave side, the leading edge or the trailing edge");
  addChoice(command, "--pattern", request->pattern, {"longitudinal", "transversal"},
            "longitudinal: passes along the blade's length; transversal: passes along its chord, or "
            "around the edge");
  addChoice(command, "--format", request->format, {"csv", "apt"},
            "csv: a table of poses with feeds; apt: a CL file");
  addOut(command, request->out, "File to write, or - for standard output");
  const auto addLength = [&](const std::string& option, double& value, const std::string& help, bool above) {
    addOption(command, option, value, "MM", numberFrom(0.0, kMaxLength, above), help);
  };
  addLength("--step-over", options.step_over, "Greatest distance between passes, on the surface", true);
  addLength("--pose-step", options.pose_step, "Greatest distance between poses", true);
  addLength("--edge-margin", options.edge_margin, "Width left out along a side's leading and trailing edge",
            false);
  addLength("--edge-reach", options.edge_reach, "Reach of the passes to either side of an edge", true);
  addLength("--depth", options.depth, "Depth to which the belt is pressed into the surface", false);
  addLength("--wheel-radius", options.wheel_radius, "Radius of the contact wheel with the belt on it", true);
  addLength("--wheel-width", request->wheel_width, "Width of the belt on the contact wheel", true);
  addLength("--retract", options.retract, "Length of approach and retraction, along the arm", false);
  const auto addAngle = [&](const std::string& option, double& value, const std::string& help) {
    addOption(command, option, value, "DEG", numberFrom(-89.0, 89.0), help);
  };
  addAngle("--tilt", options.tilt, "Angle of the arm off the surface, about the contact wheel's axis");
  addAngle("--lead", options.lead, "Angle of the arm along the surface, towards the trailing edge");
  addOption(command, "--turn-step", options.greatest_turn, "DEG", numberFrom(0.01, 90.0),
            "Greatest turn of the surface from pose to pose");
  addOption(command, "--feed", options.feed, "MM/MIN", numberFrom(0.0, 1e9, true), "Feed rate in mm/min");
  addOption(command, "--height-from", options.height_from, "FRACTION", numberFrom(0.0, 1.0),
            "Lower end of the ground region, as a fraction of the blade's height: root 0, tip 1");
  addOption(command, "--height-to", options.height_to, "FRACTION", numberFrom(0.0, 1.0),
            "Upper end of the ground region");
  command.callback([request, &exit_code] { exit_code = makePath(*request); });
}

}  // namespace octoblisk::demos
