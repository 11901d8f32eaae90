// octoblisk repair: makes a path free of interference with as little change as possible.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "command_line/blisk_options.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/print_message.h"
#include "command_line/terminal_watch.h"
#include "commands/commands.h"
#include "commands/grinding_output.h"
#include "grinding/tool_file.h"
#include "io/number_text.h"
#include "io/whole_files.h"
#include "models/length_limit.h"
#include "render/annotation.h"
#include "repair/path_repair.h"
#include "repair/repair_report.h"
#include "report/coverage_report.h"
#include "report/replay_files.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

struct RepairRequest {
  GrinderFiles files;
  double margin = 0.0;  // mm
  ChangeLimits limits;
  bool keep_contact = true;
  bool report = true;
};

void printChanges(const PathRepair& repair) {
  double tilt = 0.0, slide = 0.0, retract = 0.0;
  for (const PoseRepair& pose : repair.poses) {
    tilt = std::max(tilt, std::abs(pose.change.tilt));
    slide = std::max(slide, std::abs(pose.change.slide));
    retract = std::max(retract, pose.change.retract);
  }
  std::cout << "Changed: " << countedText(repair.changed(), "pose", "poses") << ", tilt up to " << tilt
            << " degrees, slide up to " << slide << " mm, retraction up to " << retract << " mm\n";
}

void printContact(const PathRepair& repair) {
  if (repair.contactsLost() == 0) return;
  std::cout << "Lost contact with the ground blade: " << repair.contactsLost() << " of " << repair.working()
            << " working poses: " << describeLost(repair) << '\n';
}

/// The file name of the repaired path; a CL file keeps its format and extension.
std::string nameOfPath(const GrinderFiles& files) {
  const bool is_cl = !files.path.empty() && isClFile(files.path);
  return "path" + (is_cl ? std::filesystem::path(files.path).extension().string() : std::string(".csv"));
}

/// The files of the repaired path and of its changes; those of an unfinished repair are marked.
struct RepairFiles {
  RepairFiles(const GrinderFiles& files, bool is_partial) {
    const std::filesystem::path out = files.out;
    const std::string partial = is_partial ? ".partial" : "";
    path = out / (nameOfPath(files) + partial);
    changes = out / ("changes.csv" + partial);
  }

  std::filesystem::path path, changes;
};

void printRepair(const PathRepair& repair, const GrinderInput& input, int blade, const RepairFiles& files) {
  std::cout << countedText(repair.poses.size(), "pose, ", "poses, ");
  if (blade == 0) {
    std::cout << "no blade ground";
  } else {
    std::cout << "ground blade " << blade << " of " << input.blades.count;
  }
  std::cout << ": " << repair.interferedBefore()
            << " interfered; left: " << countedText(repair.posesLeft(), "pose", "poses");
  if (repair.is_partial) {
    std::cout << "; stopped before all motions were checked\n";
  } else {
    std::cout << ", " << countedText(repair.motionsLeft(), "motion", "motions") << " between free poses\n";
  }
  if (repair.changed() > 0) printChanges(repair);
  printContact(repair);
  constexpr std::size_t kMaxLines = 20;
  const std::vector<std::string> left = describeLeft(repair, input.tool.parts, input.names());
  for (std::size_t k = 0; k < std::min(kMaxLines, left.size()); ++k) std::cout << "Left: " << left[k] << '\n';
  if (left.size() > kMaxLines)
    std::cout << "Left: " << countedText(left.size() - kMaxLines, "more run", "more runs")
              << " of poses (changes.csv)\n";
  std::cout << "Path: " << files.path.string() << ", changes: " << files.changes.string() << '\n';
}

/// Throws naming an option whose spacing is wider than the permitted step from pose to pose.
void requireBridged(const ChangeLimits& limits) {
  const std::tuple<const char*, double, double> changes[] = {
      {"tilt", limits.tilt_grid, limits.tilt_per_pose},
      {"slide", limits.slide_grid, limits.slide_per_pose},
      {"retract", limits.retract_grid, limits.retract_per_pose}};
  for (const auto& [name, grid, per_pose] : changes) {
    if (grid <= per_pose) continue;
    throw std::invalid_argument("--" + std::string(name) + "-grid: must not be above --" + name +
                                "-per-pose, or no pose could differ from the next");
  }
}

/// The job that octoblisk grind would make of the path.
GrindingJob jobOf(const GrinderFiles& files, const GrinderInput& input, const VerdictRules& rules) {
  constexpr double kMinNearMiss = 0.5;  // mm
  GrindingJob job = jobWithoutPath(files, input);
  job.rules.ground_blade = rules.ground_blade;
  job.rules.near_miss = std::clamp(rules.near_miss, kMinNearMiss, kMaxNearMiss);
  // The repair and both runs of its report have most poses and motions in common.
  job.depths = depthsUnder(input.tool.rules, input.blisk, input.tool.parts, files.threads, input.fixtures);
  job.depths->remember();
  return job;
}

GrindingRun runOf(const GrinderFiles& files, GrindingJob job, const std::vector<Pose>& path,
                  TerminalWatch& terminal) {
  job.path = path;
  GrindingRun run = runGrinding(std::move(job), terminal.watch());
  terminal.endTask();
  if (run.isPartial())
    throw TerminalWatch::stopped("stopped: the path is repaired, but the report is not written");
  nameInputs(files, run);
  return run;
}

void writeRepairReport(const GrinderFiles& files, const GrindingJob& job, const std::vector<Pose>& path,
                       const PathRepair& repaired, const std::optional<Coverage>& coverage,
                       TerminalWatch& terminal) {
  const GrindingRun before = runOf(files, job, path, terminal);
  const GrindingRun after = runOf(files, job, repaired.path, terminal);
  WholeFiles shown;
  Replay replay = repairReplay(repaired, before, after);
  if (coverage) replay.side = coverageOnBlade(*coverage);
  writeReplayFiles(replay, files.out, shown);
  shown.finish();
  std::cout << replayFilesText(files.out);
}

int repair(const RepairRequest& request) {
  const GrinderFiles& files = request.files;
  requireNotRead(files,
                 {nameOfPath(files), "changes.csv", "report.html", "run.glb", "contacts.vtk", "path.vtk"});
  requireBridged(request.limits);
  const ChangeGrid usable(request.limits);  // refuses unusable limits before any file is read
  const bool own_path = !files.path.empty();
  const GrinderInput input = readGrinder(files);
  const PathFile read = own_path ? readPath(files.path, *input.blisk) : PathFile();
  const std::vector<Pose> path = own_path ? read.poses() : builtInPath(files, input);
  TerminalWatch terminal(path.size());
  const std::optional<int> blade = groundBladeOf(files, input, path, terminal.watch());
  if (!blade) throw TerminalWatch::stopped("stopped before the first pose was done: no file was written");
  const VerdictRules rules = reachRulesOf(files, input, *blade, request.margin);
  warnOfInput(files, input);
  warnOfUntouched(files, input, *blade);
  makeFolder(files.out);

  const GrindingJob job = jobOf(files, input, rules);
  Judge judge(input.blisk, input.tool.parts, input.blades.blade_of_triangle, rules, files.threads,
              input.fixtures, job.depths);
  const PathRepair repaired = repairPath(judge, path, directionsOffSurface(judge, path), request.limits,
                                         request.keep_contact, terminal.watch());
  terminal.endTask();
  const RepairFiles written(files, repaired.is_partial);
  WholeFiles whole;
  if (own_path) {
    writeChangedPath(read, files.path, *input.blisk, repaired.path, whole.add(written.path));
  } else {
    writePoses(whole.add(written.path), repaired.path);
  }
  writeChanges(repaired, input.tool.parts, input.names(), whole.add(written.changes));
  std::optional<Coverage> coverage;
  if (*blade != 0) coverage = coverageOrWarning(files, job, repaired.path, convexSideOf("", input));
  if (coverage) {
    writeCoverage(*coverage, whole.add(std::filesystem::path(files.out) / "coverage.csv"));
    writePng(coveragePicture(*coverage),
             whole.add(std::filesystem::path(files.out) / "coverage.png").string());
  }
  whole.finish();
  printRepair(repaired, input, *blade, written);
  if (coverage) std::cout << summaryText(*coverage);
  if (repaired.is_partial) {
    throw TerminalWatch::stopped("stopped: the poses repaired so far are in " + written.path.string());
  }
  if (request.report) writeRepairReport(files, job, path, repaired, coverage, terminal);
  return repaired.isFree() && repaired.contactsLost() == 0 ? 0 : 1;
}

}  // namespace

void addRepairCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "repair");
  const auto request = std::make_shared<RepairRequest>();
  addGrinderOptions(command, request->files);
  addMarginOption(command, request->margin);
  addFile(command, "--path", request->files.path,
          "CSV file x,y,z,qw,qx,qy,qz with poses of the belt in the blisk's frame (mm), or an APT CL "
          "file. Default: the built-in path of grind");
  command.add_flag("--keep-contact,!--no-keep-contact", request->keep_contact,
                   "Keep working poses in contact with the ground blade if a change with at most 1 mm of "
                   "retraction allows it");
  ChangeLimits& limits = request->limits;
  const auto add_limit = [&](const std::string& name, double& value, const std::string& unit,
                             const std::string& help, bool above) {
    addOption(command, name, value, unit, numberFrom(0.0, kMaxLength, above), help)->group("Changes");
  };
  const auto add_angle = [&](const std::string& name, double& value, const std::string& help, bool above) {
    add_limit(name, value, "DEG", help, above);
  };
  const auto add_length = [&](const std::string& name, double& value, const std::string& help, bool above) {
    add_limit(name, value, "MM", help, above);
  };
  add_angle("--tilt", limits.tilt, "Greatest tilt in either direction, about the wheels' axis", false);
  add_angle("--tilt-per-pose", limits.tilt_per_pose, "Greatest change of the tilt from a pose to the next",
            true);
  add_angle("--tilt-grid", limits.tilt_grid, "Step between the tilts that are tried", true);
  add_length("--slide", limits.slide, "Greatest slide in either direction, along the wheels' axis", false);
  add_length("--slide-per-pose", limits.slide_per_pose,
             "Greatest change of the slide from a pose to the next", true);
  add_length("--slide-grid", limits.slide_grid, "Step between the slides that are tried", true);
  add_length("--retract", limits.retract,
             "Greatest retraction: the first millimetre leads off the surface, the rest runs along the arm",
             false);
  add_length("--retract-per-pose", limits.retract_per_pose,
             "Greatest change of the retraction from a pose to the next", true);
  add_length("--retract-grid", limits.retract_grid,
             "Step between the first ten retractions that are tried; the steps beyond are wider", true);
  addReportOption(command, request->report);
  command.callback([request, &exit_code] { exit_code = repair(*request); });
}

}  // namespace octoblisk::demos
