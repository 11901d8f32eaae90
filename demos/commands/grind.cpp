// octoblisk grind: moves the belt grinder along a path and reports every touch.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "command_line/blisk_options.h"
#include "command_line/grinder_input.h"
#include "command_line/help.h"
#include "command_line/options.h"
#include "command_line/print_message.h"
#include "command_line/terminal_watch.h"
#include "commands/commands.h"
#include "commands/grinding_output.h"
#include "grinding/tool_file.h"
#include "io/whole_files.h"
#include "models/defect_words.h"
#include "report/coverage_report.h"
#include "report/grinding_pictures.h"
#include "report/grinding_replay.h"
#include "report/grinding_report.h"
#include "report/replay_files.h"
#include "study/stop_signal.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

constexpr int kMaxFrames = 9'999;

struct GrindRequest {
  GrinderFiles files;
  std::string convex;      // empty: found
  double near_miss = 0.5;  // mm
  bool continuous = true;
  std::optional<double> belt_speed;  // m/s
  bool spindle = false;
  SpindleOptions spindle_options;
  bool no_pictures = false;
  bool report = true;
  std::size_t frames = 0;
};

/// Warns about parts whose depth is measured differently.
void warnOfParts(const GrinderFiles& files, const GrindingRun& run) {
  for (std::size_t part = 0; part < run.job.parts.size(); ++part) {
    if (run.depth_kinds[part] != DepthKind::of_part) continue;
    warnOf(files.belt.empty() ? run.job.parts[part].name : files.belt,
           openText(defectsOf(*run.job.parts[part].tree, files.threads)) +
               ": only its own points inside the blisk count for its depth");
  }
}

void print(const GrindingRun& run, const std::optional<Coverage>& coverage, const GrindRequest& request) {
  const std::filesystem::path out = request.files.out;
  std::cout << summaryText(run);
  if (coverage) std::cout << summaryText(*coverage);
  std::cout << "Tables: " << (out / "poses.csv").string() << ", " << (out / "contacts.csv").string() << ", "
            << (out / "summary.json").string() << ", " << (out / "path.csv").string() << '\n';
  if (request.report) std::cout << replayFilesText(out);
  if (request.frames > 0) {
    std::cout << "Frames: " << (out / "frames").string() << ", " << (out / "contact_sheet.png").string()
              << '\n';
  }
  if (!request.no_pictures) {
    std::cout << "Pictures: " << (out / "overview.png").string() << ", " << (out / "closeup.png").string()
              << '\n';
  }
}

/// Runs the job with a progress bar; Ctrl-C stops it.
GrindingRun runWatched(const GrindingJob& job, TerminalWatch& terminal) {
  GrindingRun run = runGrinding(job, terminal.watch());
  terminal.endTask();
  if (run.poses.empty())
    throw TerminalWatch::stopped("stopped before the first pose was done: no file was written");
  return run;
}

void writeAll(const GrindingRun& run, const std::optional<Coverage>& coverage, const PathFile& path,
              const GrindRequest& request) {
  const std::filesystem::path out = request.files.out;
  const auto isStopped = [&] { return !run.isPartial() && StopSignal::received() != 0; };
  std::error_code ignored;  // usually the file does not exist
  WholeFiles files;
  if (!std::filesystem::equivalent(request.files.path, out / "path.csv", ignored)) {
    const bool has_feeds =
        std::ranges::any_of(path.motions, [](const ToolMotion& motion) { return motion.feed > 0.0; });
    if (has_feeds) {
      writeMotions(files.add(out / "path.csv"), path.motions);
    } else {
      writePoses(files.add(out / "path.csv"), path.poses());
    }
  }
  writePoseVerdicts(run, files.add(out / "poses.csv"));
  writeContacts(run, files.add(out / "contacts.csv"));
  writeSummary(run, coverage, files.add(out / "summary.json"));
  if (run.job.spindle) writeForces(run, files.add(out / "forces.csv"));
  if (coverage) writeCoverage(*coverage, files.add(out / "coverage.csv"));
  if (!request.no_pictures && !isStopped()) {
    if (coverage) writePng(coveragePicture(*coverage), files.add(out / "coverage.png").string());
    writePngWatched(overviewOf(run), files.add(out / "overview.png").string());
    writePngWatched(closeupOf(run), files.add(out / "closeup.png").string());
  }
  if (request.frames > 0 && !isStopped()) writeFrames(run, request.frames, out, files, writePngWatched);
  if (request.report && !isStopped()) {
    writeReplayFiles(grindingReplay(run, coverage), out, files);
  }
  files.finish();
  if (isStopped())
    throw TerminalWatch::stopped("stopped: " + request.files.out + " has all tables, but not all pictures");
}

PathFile pathOf(const GrinderFiles& files, const GrinderInput& input) {
  if (!files.path.empty()) return readPath(files.path, *input.blisk);
  PathFile path;
  for (const Pose& pose : builtInPath(files, input)) path.motions.push_back({pose});
  return path;
}

GrindingJob jobOf(const GrindRequest& request, const GrinderInput& input, const PathFile& path) {
  const GrinderFiles& files = request.files;
  GrindingJob job = jobWithoutPath(files, input);
  job.rules.near_miss = request.near_miss;
  job.rules.ground_blade = files.ground_blade.value_or(files.path.empty() ? 1 : 0);
  job.find_ground_blade = !files.ground_blade && !files.path.empty() && job.rules.grinding_part != kNoPart;
  if (request.belt_speed) {
    if (job.rules.grinding_part == kNoPart) {
      throw std::invalid_argument("--belt-speed: " + files.tool +
                                  " has no part that may touch the \"ground\" blade");
    }
    job.parts[job.rules.grinding_part].belt_speed = request.belt_speed;
  }
  if (request.spindle) job.spindle = request.spindle_options;
  job.path = path.poses();
  job.continuous = request.continuous;
  return job;
}

int grind(const GrindRequest& request) {
  const GrinderFiles& files = request.files;
  requireNotRead(files, {"poses.csv", "contacts.csv", "forces.csv", "summary.json", "report.html", "run.glb",
                         "contacts.vtk", "path.vtk"});
  const GrinderInput input = readGrinder(files);
  requireMarginFits(input, "--near-miss", request.near_miss);
  for (const PairMargin& row : input.tool.rules.margins)
    requireMarginFits(input, files.tool + ": margin", row.near_miss);
  const PathFile path = pathOf(files, input);
  const GrindingJob job = jobOf(request, input, path);
  makeFolder(files.out);
  warnOfInput(files, input);
  TerminalWatch terminal(job.path.size());  // until the end, because Ctrl-C must not lose what is done
  GrindingRun run = runWatched(job, terminal);
  nameInputs(files, run);
  run.tree_seconds = input.tree_seconds;
  run.convex_side = convexSideOf(request.convex, input);
  warnOfParts(files, run);
  warnOfUntouched(files, input, run.job.rules.ground_blade);
  const std::optional<Coverage> coverage =
      coverageOrWarning(files, run.job, std::span(run.job.path).first(run.poses.size()), run.convex_side);
  writeAll(run, coverage, path, request);
  print(run, coverage, request);
  if (run.isPartial()) {
    throw TerminalWatch::stopped("stopped: " + files.out + " has the finished poses, marked as partial");
  }
  return run.interferes() ? 1 : 0;
}

}  // namespace

void addGrindCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = addSubcommand(app, "grind");
  const auto request = std::make_shared<GrindRequest>();
  addGrinderOptions(command, request->files);
  addPartitionOption(command, request->files.tree);
  addConvexOption(command, request->convex);
  addFile(command, "--path", request->files.path,
          "CSV file x,y,z,qw,qx,qy,qz[,feed] with poses of the belt in the blisk's frame (mm), or an "
          "APT CL file, whose tool axis is the arm. Default: a path along a blade's side");
  addOption(command, "--near-miss", request->near_miss, "MM", numberFrom(0.0, kMaxNearMiss, true),
            "Clearance below which a near miss is reported, for pairs without a margin in the tool "
            "file; above 0, at most 5");
  command.add_flag("--continuous,!--poses-only", request->continuous,
                   "Check the motions between poses too, or only the poses");
  addOption(command, "--belt-speed", request->belt_speed, "M/S", numberFrom(-kMaxBeltSpeed, kMaxBeltSpeed),
            "Speed of the belt in m/s. A positive speed runs from the contact side at -x over the "
            "strand at +y to the drive wheel; a negative speed runs the other way. contacts.csv then "
            "has the surface velocity at each contact of the belt. A tool file may give each part's "
            "speed");
  SpindleOptions& spindle = request->spindle_options;
  const std::string forces = "Forces (the defaults are assumed values)";
  CLI::Option* const has_spindle =
      command
          .add_flag("--spindle", request->spindle,
                    "Compute the force of the belt on the blisk, which may turn on its spindle: forces.csv")
          ->group(forces);
  const auto add_number = [&](const std::string& name, double& value, const std::string& help,
                              const std::string& unit, double most, bool above) {
    addOption(command, name, value, unit, numberFrom(0.0, most, above), help)
        ->needs(has_spindle)
        ->group(forces);
  };
  add_number("--stiffness", spindle.stiffness,
             "Stiffness of belt and contact wheel in N/mm, by the belt's depth", "N/MM", 1e6, true);
  add_number("--friction", spindle.friction, "Coefficient of friction between belt and blisk", "MU", 10.0,
             false);
  add_number("--hold", spindle.hold, "Torque that the spindle's brake holds, in N·m; 0: it turns freely",
             "NM", 1e6, false);
  add_number("--density", spindle.density, "Density of the blisk in kg/mm³", "KG/MM3", 1e-3, true);
  command.add_flag("--no-pictures", request->no_pictures, "Do not write the pictures");
  addReportOption(command, request->report);
  addOption(command, "--frames", request->frames, "N", wholeNumberFrom(0, kMaxFrames),
            "Number of poses, evenly spaced over the path, to picture in OUT/frames and together in "
            "contact_sheet.png");
  command.callback([request, &exit_code] { exit_code = grind(*request); });
}

}  // namespace octoblisk::demos
