// octoblisk access: finds the orientations in which the belt grinder can reach each point of a blade's side.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

#include "access/access_map.h"
#include "access/access_replay.h"
#include "command_line/grinder_input.h"
#include "command_line/option_checks.h"
#include "command_line/out_folder.h"
#include "command_line/report_option.h"
#include "command_line/study_options.h"
#include "command_line/subcommand_help.h"
#include "commands/access_files.h"
#include "commands/access_task.h"
#include "commands/commands.h"
#include "io/new_file.h"
#include "io/whole_files.h"
#include "models/length_limit.h"
#include "report/replay_files.h"
#include "study/run_study.h"

namespace octoblisk::demos {
namespace {

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
  command
      .add_option("--path", request->files.path,
                  "CSV file x,y,z,qw,qx,qy,qz with poses of the belt in the blisk's frame (mm), or an APT CL "
                  "file. The points are its poses that touch the ground blade or come within 0.5 mm of it; a "
                  "pose's own tilt and lead are 0. Default: a grid")
      ->type_name("FILE")
      ->check(notEmpty());
  const auto add_angle = [&](const std::string& name, double& value, const std::string& help, bool step) {
    command.add_option(name, value, help)
        ->type_name("DEG")
        ->check(step ? numberFrom(0.0, 360.0, true) : numberFrom(-360.0, 360.0))
        ->capture_default_str()
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
  command
      .add_option("--side", request->side,
                  "Side of the blade: convex, concave, forward (towards greater angles about Z) or backward")
      ->type_name("SIDE")
      ->check(oneOf({"convex", "concave", "forward", "backward"}))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--rows", grid.rows, "Number of points over the blade's height")
      ->type_name("N")
      ->check(wholeNumberFrom(1, kMaxRows))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--columns", grid.columns, "Number of points along a section")
      ->type_name("N")
      ->check(wholeNumberFrom(1, kMaxRows))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--span-from", grid.span_from, "Lowest row, as a fraction of the height: root 0, tip 1")
      ->type_name("FRACTION")
      ->check(numberFrom(0.0, 1.0))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--span-to", grid.span_to, "Highest row, as a fraction of the height")
      ->type_name("FRACTION")
      ->check(numberFrom(0.0, 1.0))
      ->capture_default_str()
      ->group(grid_group);
  command.add_option("--press", grid.depth, "Depth to which the belt is pressed into the surface")
      ->type_name("MM")
      ->check(numberFrom(0.0, kMaxLength))
      ->capture_default_str()
      ->group(grid_group);
  addShardOptions(command, request->study);
  command.add_flag("--no-picture", request->no_picture, "Do not write the picture");
  addReportOption(command, request->report);
  command.callback([request, &exit_code] { exit_code = access(*request); });
}

}  // namespace octoblisk::demos
