// octoblisk access: how the belt grinder may stand at each point of a blade's side.
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "access/access_map.h"
#include "access/access_replay.h"
#include "access/access_report.h"
#include "cmm/blade_section.h"
#include "commands/commands.h"
#include "commands/grinder_input.h"
#include "commands/option_checks.h"
#include "commands/report_option.h"
#include "models/length_limit.h"
#include "report/annotation.h"
#include "report/progress_bar.h"
#include "report/replay_files.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostAngles = 3600;
constexpr std::int64_t kMostRows = 10'000;

struct AccessRequest {
  GrinderFiles files;
  std::string side = "convex";
  SiteGridOptions grid;
  double tilt_from = -180.0, tilt_to = 179.0, tilt_step = 1.0;  // degrees
  double lead_from = 0.0, lead_to = 0.0, lead_step = 5.0;       // degrees
  bool no_picture = false;
  bool report = true;
};

int stepsOf(const std::string& name, double from, double to, double step) {
  if (to < from) throw std::invalid_argument("--" + name + "-to: is below --" + name + "-from");
  const double steps = std::floor((to - from) / step + 1e-9) + 1.0;
  if (steps > kMostAngles) {
    throw std::invalid_argument("--" + name + "-step: that are more than " + std::to_string(kMostAngles) +
                                " steps");
  }
  return static_cast<int>(steps);
}

AccessOptions anglesOf(const AccessRequest& request) {
  AccessOptions options;
  options.tilt_from = request.tilt_from;
  options.tilt_step = request.tilt_step;
  options.tilts = stepsOf("tilt", request.tilt_from, request.tilt_to, request.tilt_step);
  if ((options.tilts - 1) * options.tilt_step > 360.0 - 1e-9) {
    throw std::invalid_argument("--tilt-to: goes round to --tilt-from again, or beyond it");
  }
  options.leads.clear();
  const int leads = stepsOf("lead", request.lead_from, request.lead_to, request.lead_step);
  for (int k = 0; k < leads; ++k) options.leads.push_back(request.lead_from + k * request.lead_step);
  return options;
}

bool isForward(const AccessRequest& request, const GrinderInput& input) {
  if (request.side == "forward" || request.side == "backward") return request.side == "forward";
  const double middle = 0.5 * (input.blades.root_radius + input.blades.tip_radius);
  const BladeCutter cutter(input.blisk->mesh(), input.blades, request.grid.blade);
  try {
    return convexIsForward(cutter.at(middle)) == (request.side == "convex");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(input.blisk_name + ": " + error.what() +
                                ", so which side is convex is not known: say --side forward or backward");
  }
}

/// The grid over the side, for a belt whose contact wheel is at the origin.
std::vector<ContactSite> gridOf(AccessRequest request, const GrinderInput& input, int blade) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(input.blisk_name + ": no blades were found round the z axis: give a --path");
  }
  request.grid.blade = blade;
  request.grid.forward_side = isForward(request, input);
  request.grid.wheel_radius = -input.parts.front().tree->mesh().bounds().min.x();
  if (request.grid.wheel_radius <= request.grid.depth) {
    throw std::invalid_argument(request.files.belt +
                                ": the belt has no contact wheel at the origin towards -x");
  }
  return sitesOnBlade(input.blisk->mesh(), input.blades, request.grid);
}

std::string numberOf(std::size_t count, const std::string& one) {
  return std::to_string(count) + ' ' + one + (count == 1 ? "" : "s");
}

void tellAccess(const AccessRun& run, const std::filesystem::path& out, bool picture) {
  const std::size_t none = run.nowhereFree();
  std::cout << numberOf(run.sites.size(), "point") << " of blade " << run.rules.ground_blade << ", "
            << numberOf(static_cast<std::size_t>(run.options.tilts), "tilt") << " at "
            << numberOf(run.options.leads.size(), "lead")
            << " each: " << std::round(1000.0 * run.freeFraction()) / 10.0 << " % free; " << none
            << " nowhere free\n";
  std::map<std::string, std::size_t> in_the_way;
  for (const SiteAccess& access : run.access) {
    if (access.free == 0) ++in_the_way[describe(access.in_the_way.front().obstacle, run.parts)];
  }
  for (const auto& [what, times] : in_the_way) {
    std::cout << "  mostly in the way there: " << what << ", at " << numberOf(times, "point") << '\n';
  }
  std::cout << "Tables: " << (out / "points.csv").string() << ", " << (out / "ranges.csv").string() << '\n';
  if (picture) std::cout << "Picture: " << (out / "map.png").string() << '\n';
}

int access(const AccessRequest& request) {
  const GrinderFiles& files = request.files;
  AccessRun run;
  run.options = anglesOf(request);
  requireNotRead(
      files, {"points.csv", "ranges.csv", "map.png", "report.html", "run.glb", "contacts.vtk", "path.vtk"});
  const std::vector<Pose> path = files.path.empty() ? std::vector<Pose>{} : readPoses(files.path);
  const GrinderInput input = readGrinder(files);
  run.of_path = !files.path.empty();
  run.parts = input.parts;
  run.rules = {0, groundBladeOf(files, input, path), files.max_depth, files.margin};
  if (run.of_path && run.rules.ground_blade == 0) {
    throw std::invalid_argument(files.path +
                                ": the belt touches no blade at any of its poses: say --ground-blade");
  }
  run.sites = run.of_path ? sitesOfPath(input.blisk->mesh(), input.blades, run.rules.ground_blade,
                                        *input.parts.front().tree, path)
                          : gridOf(request, input, run.rules.ground_blade);
  if (run.sites.empty()) {
    throw std::invalid_argument(files.path + ": at no pose is the belt within 0.5 mm of blade " +
                                std::to_string(run.rules.ground_blade));
  }
  warnOfInput(input);
  makeFolder(files.out);
  PoseJudge judge(input.blisk, input.parts, input.blades.blade_of_triangle, run.rules, files.threads);
  {
    ProgressBar progress(std::cerr, run.sites.size());
    run.access = accessOf(judge, run.sites, run.options, [&](std::size_t done) { progress.update(done); });
  }
  const std::filesystem::path out = files.out;
  writePoints(run, out / "points.csv");
  writeRanges(run, out / "ranges.csv");
  if (!request.no_picture) writePng(accessPicture(run), (out / "map.png").string());
  tellAccess(run, out, !request.no_picture);
  if (request.report) {
    WholeFiles shown;
    writeReplayFiles(accessReplay(run, input.blisk, input.blades, input.blisk_name), out, shown);
    shown.finish();
    std::cout << tellReplayFiles(out);
  }
  return run.nowhereFree() > 0 ? 1 : 0;
}

}  // namespace

void addAccessCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = *app.add_subcommand(
      "access",
      "Map where the belt grinder may stand: at each contact point the tilts and leads at which nothing\n"
      "touches that must not. The points are a grid on one side of a blade, or those of a path.");
  const auto request = std::make_shared<AccessRequest>();
  addGrinderOptions(command, request->files);
  command
      .add_option("--path", request->files.path,
                  "CSV file x,y,z,qw,qx,qy,qz: the belt in the blisk's frame (mm). Its poses that touch the "
                  "ground blade, or come within 0.5 mm, are the points, and their own tilt and lead are 0; "
                  "default: a grid")
      ->check(notEmpty());
  const auto add_angle = [&](const std::string& name, double& value, const std::string& help, bool step) {
    command.add_option(name, value, help)
        ->check(step ? numberFrom(0.0, 360.0, true) : numberFrom(-360.0, 360.0))
        ->capture_default_str()
        ->group("Angles");
  };
  add_angle("--tilt-from", request->tilt_from, "Degrees about the wheels' axis", false);
  add_angle("--tilt-to", request->tilt_to, "Degrees", false);
  add_angle("--tilt-step", request->tilt_step, "Degrees; between them nothing is asked", true);
  add_angle("--lead-from", request->lead_from, "Degrees about the normal of the surface", false);
  add_angle("--lead-to", request->lead_to, "Degrees", false);
  add_angle("--lead-step", request->lead_step, "Degrees", true);
  SiteGridOptions& grid = request->grid;
  const std::string grid_group = "Grid, without --path";
  command
      .add_option("--side", request->side,
                  "convex or concave, or: forward (towards greater angles about Z) or backward")
      ->check(CLI::IsMember({"convex", "concave", "forward", "backward"}))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--rows", grid.rows, "Number of points over the blade's height")
      ->check(wholeNumberFrom(1, kMostRows))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--columns", grid.columns, "Number of points along a section")
      ->check(wholeNumberFrom(1, kMostRows))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--span-from", grid.span_from, "Part of the height, root 0 to tip 1, of the lowest row")
      ->check(numberFrom(0.0, 1.0))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--span-to", grid.span_to, "Part of the height of the highest row")
      ->check(numberFrom(0.0, 1.0))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--press", grid.depth, "mm that the belt is pressed into the surface")
      ->check(numberFrom(0.0, kMaxLength))
      ->capture_default_str()
      ->group(grid_group);
  command.add_flag("--no-picture", request->no_picture, "Leave the picture out");
  addReportOption(command, request->report);
  command.footer(
      std::string(kReportFooter) +
      "Written, in OUT:\n"
      "  points.csv  a row for each point: place and normal, height above the blade's root and arc length\n"
      "              from its leading edge (mm), free part of all tilts and leads, the widest free range of\n"
      "              tilt and its lead, the leads free about its middle, and the part most often in the way\n"
      "  ranges.csv  every free range of tilt; one across 180 degrees goes on above it\n"
      "  map.png     the side unrolled, coloured by the widest range\n"
      "At tilt 0 of a grid the arm lies along the surface, away from the axis, and at 90 it stands square "
      "to\n"
      "it; lead turns the arm towards the wheels' axis. Free is what grind does not call interference, and\n"
      "keeps the margin. Points are numberOf from 0.\n"
      "Exit codes: 0 every point has a free pose, 1 some have none, 2 bad input.");
  command.callback([request, &exit_code] { exit_code = access(*request); });
}

}  // namespace octoblisk::demos
