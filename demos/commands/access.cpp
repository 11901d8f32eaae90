// octoblisk access: how the belt grinder may stand at each point of a blade's side.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "access/access_map.h"
#include "access/access_replay.h"
#include "access/access_report.h"
#include "cmm/blade_section.h"
#include "commands/access_files.h"
#include "commands/commands.h"
#include "commands/grinder_input.h"
#include "commands/option_checks.h"
#include "commands/out_folder.h"
#include "commands/report_option.h"
#include "commands/study_options.h"
#include "models/blisk_axis.h"
#include "models/length_limit.h"
#include "report/annotation.h"
#include "report/replay_files.h"
#include "report/whole_files.h"
#include "study/node_inputs.h"
#include "study/run_study.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostAngles = 3600;
constexpr std::int64_t kMostRows = 10'000;

struct AccessRequest {
  GrinderFiles files;
  double margin = 0.0;  // mm
  std::string side = "convex";
  SiteGridOptions grid;
  StudyTarget study;                                            // but for its file
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

bool isForward(const AccessRequest& request, const TriangleMesh& blisk, const BladesFound& blades) {
  if (request.side == "forward" || request.side == "backward") return request.side == "forward";
  const double middle = 0.5 * (blades.root_radius + blades.tip_radius);
  const BladeCutter cutter(blisk, blades, request.grid.blade);
  try {
    return convexIsForward(cutter.at(middle)) == (request.side == "convex");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(request.files.bliskName() + ": " + error.what() +
                                ", so which side is convex is not known: say --side forward or backward");
  }
}

const ClusteredOctree& beltOf(const GrinderInput& input) {
  return *input.tool.parts[input.tool.rules.grinding_part].tree;
}

/// The grid over the side, for a belt whose contact wheel is at the origin.
std::vector<ContactSite> gridOf(AccessRequest request, const GrinderInput& input, const TriangleMesh& blisk,
                                int blade) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(request.files.bliskName() + ": no blades were found: give a --path");
  }
  request.grid.blade = blade;
  request.grid.forward_side = isForward(request, blisk, input.blades);
  request.grid.wheel_radius = -beltOf(input).mesh().bounds().min.x();
  if (request.grid.wheel_radius <= request.grid.depth) {
    throw std::invalid_argument(request.files.toolName() +
                                ": the belt has no contact wheel at the origin towards -x");
  }
  return sitesOnBlade(blisk, input.blades, request.grid);
}

/// Of the grid or the path, in the frame of the blisk's file.
std::vector<ContactSite> sitesAsked(const AccessRequest& request, const GrinderInput& input, int blade,
                                    std::vector<Pose> path) {
  const TriangleMesh blisk = moved(input.blisk->mesh(), input.mesh_in_blisk);
  for (Pose& pose : path) pose = input.mesh_in_blisk * pose;
  std::vector<ContactSite> sites = request.files.path.empty()
                                       ? gridOf(request, input, blisk, blade)
                                       : sitesOfPath(blisk, input.blades, blade, beltOf(input), path);
  const Pose blisk_in_mesh = input.mesh_in_blisk.inverse();
  for (ContactSite& site : sites) {
    site.point = blisk_in_mesh * site.point;
    site.normal = blisk_in_mesh.rotation * site.normal;
    site.base = blisk_in_mesh * site.base;
  }
  return sites;
}

/// All that a map is made of.
struct AccessTask {
  GrinderInput input;
  AccessQuestion question;
  std::vector<ContactSite> sites;
  std::unique_ptr<PoseJudge> judge;
  std::vector<SiteAccess> answered;  ///< of each point; a point answered elsewhere has no pose that was tried
  std::size_t answered_here = 0;     ///< points
};

void prepare(const AccessRequest& request, AccessTask& task) {
  const GrinderFiles& files = request.files;
  const GrinderInput& input = task.input;
  AccessQuestion& question = task.question;
  question.of_path = !files.path.empty();
  const std::vector<Pose> path = question.of_path ? readPath(files.path, *input.blisk) : std::vector<Pose>{};
  question.rules = reachRulesOf(files, input, groundBladeOf(files, input, path).value(), request.margin);
  const int blade = question.rules.ground_blade;
  if (question.of_path && blade == 0) {
    throw std::invalid_argument(files.path +
                                ": the belt touches no blade at any of its poses: say --ground-blade");
  }
  task.sites = sitesAsked(request, input, blade, path);
  if (task.sites.empty()) {
    throw std::invalid_argument(files.path + ": at no pose is the belt within 0.5 mm of blade " +
                                std::to_string(blade));
  }
  task.judge = std::make_unique<PoseJudge>(input.blisk, input.tool.parts, input.blades.blade_of_triangle,
                                           question.rules, files.threads);
}

/// What the table of points depends on.
Study studyOf(const AccessTask& task) {
  Study study;
  study.name = kAccessName;
  study.columns = accessColumns();
  study.items = task.sites.size();
  study.group = kSitesAtOnce;
  std::vector<Pose> sites;
  for (const ContactSite& site : task.sites) {
    sites.push_back(site.base);
    sites.push_back({Mat3::Identity(), site.point});
  }
  study.inputs = {{"blisk", fingerprintOf(task.input.blisk->mesh())},
                  {"points", fingerprintOf(std::span<const Pose>(sites))}};
  for (const ToolPart& part : task.input.tool.parts) {
    std::string word = part.name;
    std::ranges::replace(word, ' ', '_');
    study.inputs.push_back({word, fingerprintOf(part.tree->mesh())});
  }
  study.options = lineOf(task.question);
  return study;
}

std::vector<AnsweredGroup> answerSites(AccessTask& task, ItemRange items) {
  const std::vector<ToolPart>& parts = task.input.tool.parts;
  const auto asked = std::span(task.sites).subspan(items.begin, items.size());
  const std::vector<SiteAccess> found = accessOf(*task.judge, asked, task.question.options);
  task.answered.resize(task.sites.size());
  std::ranges::copy(found, task.answered.begin() + static_cast<std::ptrdiff_t>(items.begin));
  task.answered_here += found.size();
  std::vector<AnsweredGroup> groups;
  for (std::size_t begin = items.begin; begin < items.end; begin += kSitesAtOnce) {
    AnsweredGroup& group = groups.emplace_back();
    group.items = {begin, std::min(items.end, begin + kSitesAtOnce)};
    AccessSummary summary;
    for (std::size_t s = begin; s < group.items.end; ++s) {
      const SiteAccess& access = found[s - items.begin];
      group.rows += rowOfSite(s, task.sites[s], access, task.question, parts);
      summary.count(access, parts);
    }
    group.tally = tallyOf(summary);
  }
  return groups;
}

/// Of a map of which every point was answered by this process: shards, ranks and what is resumed have none.
void writeReport(AccessTask& task, const GrinderFiles& files) {
  if (task.answered_here != task.sites.size()) {
    std::cout << "Report: none, as not all points were answered here\n";
    return;
  }
  const AccessMap map{task.question, std::move(task.sites), std::move(task.answered), task.input.tool.parts};
  WholeFiles shown;
  writeReplayFiles(accessReplay(map, task.input.blisk, task.input.blades, files.bliskName()), files.out,
                   shown);
  shown.finish();
  std::cout << tellReplayFiles(files.out);
}

/// The exit code; 0 at all ranks but the first.
int access(AccessRequest request) {
  GrinderFiles& files = request.files;
  AccessTask task;
  task.question.options = anglesOf(request);
  StudyTarget target{files.out, request.study.shard, request.study.resume};
  if (!target.shard) {
    requireNotRead(
        files, {"points.csv", "ranges.csv", "map.png", "report.html", "run.glb", "contacts.vtk", "path.vtk"});
    target.out = (std::filesystem::path(files.out) / "points.csv").string();
  }
  Ranks ranks;
  if (files.threads == 0) files.threads = ranks.threadsEach();
  task.input = readGrinder(files, ranks);
  ranks.together([&] {
    prepare(request, task);
    if (!ranks.isFirst()) return;
    warnOfInput(files, task.input);
    if (!target.shard) makeFolder(files.out);
  });
  const StudyOutcome outcome =
      runStudy(studyOf(task), target, {files.blisk, files.belt, files.tool, files.path}, ranks,
               [&](ItemRange items) { return answerSites(task, items); });
  if (!ranks.isFirst()) return 0;
  const int exit_code = tellAccess(outcome.tallies, task.question);
  if (!target.shard) {
    finishAccess(target.out, task.question, !request.no_picture);
    if (request.report) writeReport(task, files);
  }
  return exit_code;
}

}  // namespace

void finishAccess(const std::filesystem::path& points, const AccessQuestion& question, bool picture) {
  const std::filesystem::path out = points.parent_path();
  const std::vector<AccessRow> rows = readAccessTable(points);
  WholeFiles files;
  writeRanges(rows, files.add(out / "ranges.csv"));
  if (picture) writePng(accessPicture(rows, question), files.add(out / "map.png").string());
  files.finish();
  std::cout << "Tables: " << points.string() << ", " << (out / "ranges.csv").string() << '\n';
  if (picture) std::cout << "Picture: " << (out / "map.png").string() << '\n';
}

int tellAccess(std::span<const std::string> tallies, const AccessQuestion& question) {
  AccessSummary summary;
  for (const std::string& tally : tallies) summary.add(accessSummaryOfTally(tally));
  std::cout << inWords(summary, question);
  return summary.nowhere_free > 0 ? 1 : 0;
}

void addAccessCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = *app.add_subcommand(
      "access",
      "Map where the belt grinder may stand: at each contact point the tilts and leads at which nothing\n"
      "touches that must not. The points are a grid on one side of a blade, or those of a path.");
  const auto request = std::make_shared<AccessRequest>();
  addGrinderOptions(command, request->files);
  addMarginOption(command, request->margin);
  command
      .add_option("--path", request->files.path,
                  "CSV file x,y,z,qw,qx,qy,qz: the belt in the blisk's frame (mm), or an APT CL file. Its "
                  "poses that touch the "
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
  addShardOptions(command, request->study);
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
      "keeps the margin. Points are counted from 0.\n"
      "With --shard OUT is a file, a part of points.csv: octoblisk merge PARTS --out DIR/points.csv makes "
      "that\n"
      "of all parts, and the other two beside it.\n" +
      studyFooter("OUT/points.csv.partial") +
      "Exit codes: 0 every point has a free pose, 1 some have none, 2 bad input; 130, 143 stopped.");
  command.callback([request, &exit_code] { exit_code = access(*request); });
}

}  // namespace octoblisk::demos
