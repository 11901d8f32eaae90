// octoblisk access: finds the orientations in which the belt grinder can reach each point of a blade's side.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "access/access_map.h"
#include "access/access_replay.h"
#include "access/access_summary.h"
#include "access/access_table.h"
#include "access/contact_site.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "commands/access_files.h"
#include "commands/commands.h"
#include "grinding/judge.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "models/blade_section.h"
#include "models/blisk_axis.h"
#include "models/length_limit.h"
#include "report/replay_files.h"
#include "study/node_inputs.h"
#include "study/run_study.h"

namespace octoblisk::demos {
namespace {

struct AccessRequest {
  GrinderFiles files;
  double margin = 0.0;  ///< mm
  std::string side = "convex";
  SiteGridOptions grid;
  StudyTarget study;                                            ///< without its file
  double tilt_from = -180.0, tilt_to = 179.0, tilt_step = 1.0;  ///< degrees
  double lead_from = 0.0, lead_to = 0.0, lead_step = 5.0;       ///< degrees
  bool no_picture = false;
  bool report = true;
};

/// The inputs and answers of a map.
struct AccessTask {
  GrinderInput input;
  AccessQuestion question;
  std::vector<ContactSite> sites;
  std::unique_ptr<Judge> judge;
  std::vector<SiteAccess> answered;  ///< per point; a point answered by another process has no tried pose
  std::size_t answered_here = 0;     ///< points
};

constexpr int kMaxAngles = 3600;

int stepsOf(const std::string& name, double from, double to, double step) {
  if (to < from) throw std::invalid_argument("--" + name + "-to: must not be below --" + name + "-from");
  const double steps = std::floor((to - from) / step + 1e-9) + 1.0;
  if (steps > kMaxAngles) {
    throw std::invalid_argument("--" + name + "-step: too small: it makes more than " +
                                std::to_string(kMaxAngles) + " steps");
  }
  return static_cast<int>(steps);
}

bool isForward(const AccessRequest& request, const TriangleMesh& blisk, const BladesFound& blades) {
  if (request.side == "forward" || request.side == "backward") return request.side == "forward";
  const double middle = 0.5 * (blades.root_radius + blades.tip_radius);
  const BladeCutter cutter(blisk, blades, request.grid.blade);
  try {
    return convexIsForward(cutter.at(middle)) == (request.side == "convex");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(request.files.bliskName() + ": " + error.what() +
                                ", so the convex side is unknown: give --side forward or --side backward");
  }
}

const ClusteredOctree& beltOf(const GrinderInput& input) {
  return *input.tool.parts[input.tool.rules.grinding_part].tree;
}

/// The grid over the side, for a belt with its contact wheel at the origin.
std::vector<ContactSite> gridOf(AccessRequest request, const GrinderInput& input, const TriangleMesh& blisk,
                                int blade) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(request.files.bliskName() +
                                ": no blades were found: give a path with --path");
  }
  request.grid.blade = blade;
  request.grid.forward_side = isForward(request, blisk, input.blades);
  request.grid.wheel_radius = -beltOf(input).mesh().bounds().min.x();
  if (request.grid.wheel_radius <= request.grid.depth) {
    throw std::invalid_argument(request.files.toolName() +
                                ": the belt has no contact wheel at the origin, on its -x side");
  }
  return sitesOnBlade(blisk, input.blades, request.grid);
}

/// The sites of the grid or of the path, in the frame of the blisk's file.
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

/// Throws std::invalid_argument naming an option that leaves no tilt or lead, or too many.
AccessOptions anglesOf(const AccessRequest& request) {
  AccessOptions options;
  options.tilt_from = request.tilt_from;
  options.tilt_step = request.tilt_step;
  options.tilts = stepsOf("tilt", request.tilt_from, request.tilt_to, request.tilt_step);
  if ((options.tilts - 1) * options.tilt_step > 360.0 - 1e-9) {
    throw std::invalid_argument("--tilt-to: must be less than a full turn beyond --tilt-from");
  }
  options.leads.clear();
  const int leads = stepsOf("lead", request.lead_from, request.lead_to, request.lead_step);
  for (int k = 0; k < leads; ++k) options.leads.push_back(request.lead_from + k * request.lead_step);
  return options;
}

/// Fills in everything but the input and the question's angles, which must be set, and the answers. Throws
/// naming the file or the blade if there is nothing to check.
void prepareTask(const AccessRequest& request, AccessTask& task) {
  const GrinderFiles& files = request.files;
  const GrinderInput& input = task.input;
  AccessQuestion& question = task.question;
  question.of_path = !files.path.empty();
  const std::vector<Pose> path =
      question.of_path ? readPath(files.path, *input.blisk).poses() : std::vector<Pose>{};
  question.rules = reachRulesOf(files, input, groundBladeOf(files, input, path).value(), request.margin);
  const int blade = question.rules.ground_blade;
  if (question.of_path && blade == 0) {
    throw std::invalid_argument(
        files.path + ": the belt touches no blade at any pose: name the blade with --ground-blade");
  }
  task.sites = sitesAsked(request, input, blade, path);
  if (task.sites.empty()) {
    throw std::invalid_argument(files.path + ": the belt never comes within 0.5 mm of blade " +
                                std::to_string(blade));
  }
  task.judge = std::make_unique<Judge>(input.blisk, input.tool.parts, input.blades.blade_of_triangle,
                                       question.rules, files.threads, input.fixtures);
}

/// Everything that the table of points depends on.
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
  for (const Fixture& fixture : task.input.fixtures) {
    std::string word = "obstacle " + fixture.name;
    std::ranges::replace(word, ' ', '_');
    study.inputs.push_back({word, fingerprintOf(fixture.tree->mesh())});
  }
  study.options = lineOf(task.question);
  return study;
}

/// Answers points, which are whole groups of the study, and keeps the answers in the task.
std::vector<AnsweredGroup> answerSites(AccessTask& task, ItemRange items) {
  const std::vector<ToolPart>& parts = task.input.tool.parts;
  const BodyNames names = task.input.names();
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
      group.rows += rowOfSite(s, task.sites[s], access, task.question, parts, names);
      summary.count(access, parts, names);
    }
    group.tally = tallyOf(summary);
  }
  return groups;
}

constexpr std::int64_t kMaxRows = 10'000;

/// Writes the report only if this process answered every point: shards, ranks and resumed runs lack answers.
void writeReport(AccessTask& task, const GrinderFiles& files) {
  if (task.answered_here != task.sites.size()) {
    std::cout << "Report: not written, because this process did not answer all points\n";
    return;
  }
  const AccessMap map{task.question,         std::move(task.sites),   std::move(task.answered),
                      task.input.tool.parts, task.input.blades.count, task.input.fixtures};
  WholeFiles shown;
  writeReplayFiles(accessReplay(map, task.input.blisk, task.input.blades, files.bliskName()), files.out,
                   shown);
  shown.finish();
  std::cout << replayFilesText(files.out);
}

/// Returns the exit code; 0 on all ranks but the first.
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
    prepareTask(request, task);
    if (!ranks.isFirst()) return;
    warnOfInput(files, task.input);
    if (!target.shard) makeFolder(files.out);
  });
  const StudyOutcome outcome =
      runStudy(studyOf(task), target, {files.blisk, files.belt, files.tool, files.path}, ranks,
               [&](ItemRange items) { return answerSites(task, items); });
  if (!ranks.isFirst()) return 0;
  const int exit_code =
      printAccess(outcome.tallies, task.question, isStandardOutput(target.out) ? std::cerr : std::cout);
  if (!target.shard) {
    finishAccess(target.out, task.question, !request.no_picture);
    if (request.report) writeReport(task, files);
  }
  return exit_code;
}

}  // namespace

void addAccessCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "access");
  const auto request = std::make_shared<AccessRequest>();
  addGrinderOptions(command, request->files);
  addMarginOption(command, request->margin);
  addFile(command, "--path", request->files.path,
          "CSV file x,y,z,qw,qx,qy,qz with poses of the belt in the blisk's frame (mm), or an APT CL "
          "file. The points are its poses that touch the ground blade or come within 0.5 mm of it; a "
          "pose's own tilt and lead are 0. Default: a grid");
  const auto add_angle = [&](const std::string& name, double& value, const std::string& help, bool step) {
    addOption(command, name, value, "DEG", step ? numberFrom(0.0, 360.0, true) : numberFrom(-360.0, 360.0),
              help)
        ->group("Angles");
  };
  add_angle("--tilt-from", request->tilt_from, "First tilt, about the wheels' axis", false);
  add_angle("--tilt-to", request->tilt_to, "Last tilt", false);
  add_angle("--tilt-step", request->tilt_step, "Step of the tilt; angles between steps are not checked",
            true);
  add_angle("--lead-from", request->lead_from, "First lead, about the normal of the surface", false);
  add_angle("--lead-to", request->lead_to, "Last lead", false);
  add_angle("--lead-step", request->lead_step, "Step of the lead", true);
  SiteGridOptions& grid = request->grid;
  const std::string grid_group = "Grid, without --path";
  const auto add_of_grid = [&](const std::string& name, auto& value, const std::string& placeholder,
                               const CLI::Validator& check, const std::string& help) {
    addOption(command, name, value, placeholder, check, help)->group(grid_group);
  };
  addChoice(command, "--side", request->side, {"convex", "concave", "forward", "backward"},
            "Side of the blade: convex, concave, forward (towards greater angles about Z) or backward")
      ->group(grid_group);
  add_of_grid("--rows", grid.rows, "N", wholeNumberFrom(1, kMaxRows),
              "Number of points over the blade's height");
  add_of_grid("--columns", grid.columns, "N", wholeNumberFrom(1, kMaxRows),
              "Number of points along a section");
  add_of_grid("--span-from", grid.span_from, "FRACTION", numberFrom(0.0, 1.0),
              "Lowest row, as a fraction of the height: root 0, tip 1");
  add_of_grid("--span-to", grid.span_to, "FRACTION", numberFrom(0.0, 1.0),
              "Highest row, as a fraction of the height");
  add_of_grid("--press", grid.depth, "MM", numberFrom(0.0, kMaxLength),
              "Depth to which the belt is pressed into the surface");
  addShardOptions(command, request->study);
  command.add_flag("--no-picture", request->no_picture, "Do not write the picture");
  addReportOption(command, request->report);
  command.callback([request, &exit_code] { exit_code = access(*request); });
}

}  // namespace octoblisk::demos
