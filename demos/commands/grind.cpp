// octoblisk grind: moves the belt grinder along a path and tells what touches what.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "cell/grinding_run.h"
#include "cell/tool_assembly.h"
#include "cell/tool_file.h"
#include "commands/commands.h"
#include "commands/interrupt.h"
#include "commands/option_checks.h"
#include "models/belt_grinder.h"
#include "models/embedded_assets.h"
#include "models/length_limit.h"
#include "models/open_edges.h"
#include "models/shared_tree.h"
#include "report/grinding_frames.h"
#include "report/grinding_pictures.h"
#include "report/grinding_report.h"
#include "report/grinding_words.h"
#include "report/progress_bar.h"
#include "report/whole_files.h"
#include "toolpath/grinding_path.h"
#include "toolpath/path_file.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostBlades = 10'000;

struct GrindRequest {
  std::string blisk, belt, tool, path;  // files; empty: the defaults
  std::string out;
  std::optional<int> ground_blade;
  double max_depth = 0.1;  // mm
  double near_miss = 0.5;  // mm
  bool continuous = true;
  bool no_pictures = false;
  int frames = 0;
  int threads = 0;
};

std::string nameOfBlisk(const GrindRequest& request) {
  return request.blisk.empty() ? "the blisk" : request.blisk;
}

ToolAssembly toolAsked(const GrindRequest& request) {
  if (!request.tool.empty()) return toolOf(request.tool, request.max_depth);
  if (!request.belt.empty()) return beltAlone(request.belt, request.max_depth);
  return builtInTool(request.max_depth);
}

void warn(const std::string& of, const std::string& what) {
  std::cerr << "octoblisk: warning: " << of << ": " << what << '\n';
}

/// The poses of the user's file, a table or a CL file.
std::vector<Pose> readPath(const std::string& file, const ClusteredOctree& blisk) {
  const PathFile path = readPathFile(file, blisk);
  for (const ClSkipped& skipped : path.unknown) {
    warn(file, skipped.word + ", first in line " + std::to_string(skipped.line) + ", is passed over");
  }
  std::vector<Pose> poses;
  for (const ToolMove& move : path.moves) poses.push_back(move.tool_in_blisk);
  return poses;
}

std::vector<Pose> pathOf(const GrindRequest& request, const ClusteredOctree& blisk,
                         const BladesFound& blades) {
  if (!request.path.empty()) return readPath(request.path, blisk);
  if (blades.count == 0) {
    throw std::invalid_argument(
        nameOfBlisk(request) +
        ": no blades were found round the z axis, so no path can be made: give one by --path");
  }
  const BeltParameters belt;
  GrindingPathOptions options;
  options.blade = request.ground_blade.value_or(1);
  options.wheel_radius = belt.contact_wheel_radius + belt.thickness;
  return makeGrindingPath(blisk.mesh(), blades, options);
}

/// The blade that is ground: that asked for, or the path's; to be found where the path is the user's.
void chooseGroundBlade(const GrindRequest& request, GrindingJob& job) {
  const int blades = job.blades.count;
  if (request.ground_blade && (*request.ground_blade < 1 || *request.ground_blade > blades)) {
    throw std::invalid_argument("--ground-blade " + std::to_string(*request.ground_blade) +
                                ": the blisk has " + std::to_string(blades) + " blades, numbered from 1");
  }
  if (request.ground_blade && job.rules.grinding_part == kNoPart) {
    throw std::invalid_argument("--ground-blade: no part may touch it: " + request.tool +
                                " has no row of \"allowed\" with \"ground\"");
  }
  if (const int named = greatestBladeNamed(job.rules); named > blades) {
    throw std::invalid_argument(request.tool + ": blade " + std::to_string(named) + ": the blisk has " +
                                std::to_string(blades) + " blades, numbered from 1");
  }
  job.rules.ground_blade = request.ground_blade.value_or(request.path.empty() ? 1 : 0);
  job.find_ground_blade =
      !request.ground_blade && !request.path.empty() && job.rules.grinding_part != kNoPart;
}

/// Refuses to write a table over a file that is read; path.csv is kept where it is the path read.
void requireNoInputAmongTables(const GrindRequest& request) {
  for (const char* table : {"poses.csv", "contacts.csv", "summary.json"}) {
    const std::filesystem::path file = std::filesystem::path(request.out) / table;
    for (const std::string& input : {request.path, request.tool}) {
      std::error_code ignored;  // mostly there is no such file
      if (std::filesystem::equivalent(input, file, ignored)) {
        throw std::runtime_error(file.string() + ": cannot be both read and written");
      }
    }
  }
}

/// What is checked otherwise than one may think.
void warnOf(const GrindRequest& request, const GrindingRun& run, const BladesFound& blades) {
  // A path of the user's own is then checked against hub and shroud alone.
  if (blades.count == 0) {
    warn(nameOfBlisk(request),
         "no blades were found round the z axis: every touch counts as interference with hub or shroud");
  }
  if (blades.shrouded && request.path.empty()) {
    warn(nameOfBlisk(request),
         "a shroud joins the blades' tips, and the built-in path leads through it: give a path by --path");
  }
  const auto is_of = [&](DepthKind kind) {
    return std::ranges::find(run.depth_kinds, kind) != run.depth_kinds.end();
  };
  for (std::size_t part = 0; part < run.parts.size(); ++part) {
    if (run.depth_kinds[part] != DepthKind::of_part) continue;
    warn(request.belt.empty() ? run.parts[part].name : request.belt,
         describe(openEdges(run.parts[part].tree->mesh())) +
             ": its depth is that of its surface in the blisk");
  }
  if (is_of(DepthKind::of_pairs)) {
    warn(nameOfBlisk(request),
         describe(openEdges(run.blisk->mesh())) +
             ", so it is no solid: depths are those of pairs of triangles, which shrink as meshes get finer, "
             "and a part wholly inside goes unnoticed");
  }
}

void tell(const GrindingRun& run, const std::filesystem::path& out, bool pictures) {
  std::cout << inWords(run);
  std::cout << "Tables: " << (out / "poses.csv").string() << ", " << (out / "contacts.csv").string() << ", "
            << (out / "summary.json").string() << ", " << (out / "path.csv").string() << '\n';
  if (pictures) {
    std::cout << "Pictures: " << (out / "overview.png").string() << ", " << (out / "closeup.png").string()
              << '\n';
  }
}

/// The job done, with a bar and Ctrl-C.
GrindingRun runWatched(const GrindingJob& job) {
  const InterruptWatch interrupt;
  std::optional<ProgressBar> bar;
  std::string task_shown;
  RunWatch watch;
  watch.progress = [&](const std::string& task, std::size_t done) {
    if (task != task_shown) bar.emplace(std::cerr, job.path.size());
    task_shown = task;
    bar->update(done);
  };
  watch.stop = [] { return InterruptWatch::interrupted(); };
  GrindingRun run = runGrinding(job, watch);
  if (run.poses.empty()) throw std::runtime_error("stopped before a pose was done: nothing is written");
  return run;
}

void writeAll(const GrindingRun& run, const std::vector<Pose>& path, const GrindRequest& request) {
  const std::filesystem::path out = request.out;
  std::error_code ignored;  // mostly there is no such file
  WholeFiles files;
  if (!std::filesystem::equivalent(request.path, out / "path.csv", ignored)) {
    writePoses(files.add(out / "path.csv"), path);
  }
  writePoseVerdicts(run, files.add(out / "poses.csv"));
  writeContacts(run, files.add(out / "contacts.csv"));
  writeSummary(run, files.add(out / "summary.json"));
  if (!request.no_pictures) {
    writePng(overviewOf(run), files.add(out / "overview.png").string());
    writePng(closeupOf(run), files.add(out / "closeup.png").string());
  }
  if (request.frames > 0) writeFrames(run, static_cast<std::size_t>(request.frames), out, files);
  files.finish();
}

int grind(const GrindRequest& request) {
  requireNoInputAmongTables(request);
  ToolAssembly tool = toolAsked(request);
  GrindingJob job;
  job.blisk = treeOf(request.blisk.empty() ? embeddedBlisk() : readOutward(request.blisk, tool.notes));
  for (const std::string& note : tool.notes) std::cout << note << '\n';
  job.blades = findBlades(job.blisk->mesh());
  job.parts = std::move(tool.parts);
  job.rules = std::move(tool.rules);
  job.rules.near_miss = request.near_miss;
  job.continuous = request.continuous;
  job.threads = request.threads;
  chooseGroundBlade(request, job);
  job.path = pathOf(request, *job.blisk, job.blades);

  std::error_code error;
  std::filesystem::create_directories(request.out, error);
  if (error) throw std::runtime_error(request.out + ": the folder cannot be made: " + error.message());
  GrindingRun run = runWatched(job);
  run.blisk_name = request.blisk.empty() ? "default" : request.blisk;
  run.tool_name = !request.tool.empty() ? request.tool : request.belt.empty() ? "default" : request.belt;
  run.path_name = request.path.empty() ? "generated" : request.path;
  warnOf(request, run, job.blades);
  writeAll(run, job.path, request);
  tell(run, request.out, !request.no_pictures);
  return run.interferes() ? 1 : 0;
}

}  // namespace

void addGrindCommand(CLI::App& app, int& exit_code) {
  CLI::App& command = *app.add_subcommand(
      "grind",
      "Check a belt grinder along a path over a blisk, in a Bullet world. The belt is there to touch the "
      "blade\n"
      "that it grinds; every other touch is interference. The built-in path is not free of it on purpose.");
  const auto request = std::make_shared<GrindRequest>();
  command.add_option("--blisk", request->blisk, "Mesh file (mm, axis Z); default: the built-in blisk")
      ->check(notEmpty());
  command
      .add_option(
          "--belt", request->belt,
          "Mesh file of a belt (mm, contact wheel at the origin, arm along +x), checked alone; default: the "
          "built-in grinder with belt, wheels and arm")
      ->check(notEmpty());
  CLI::Option* const belt = command.get_option("--belt");
  command
      .add_option("--tool", request->tool,
                  "JSON file of a tool's parts, what each may touch and how far it must keep from the rest; "
                  "'octoblisk make grinder' writes one")
      ->check(notEmpty())
      ->excludes(belt);
  command
      .add_option("--path", request->path,
                  "CSV file x,y,z,qw,qx,qy,qz[,feed]: the belt in the blisk's frame (mm); or an APT CL file, "
                  "whose tool axis "
                  "is the arm; default: along a blade's side")
      ->check(notEmpty());
  command.add_option("-o,--out", request->out, "Folder for tables and pictures; made where missing")
      ->required()
      ->check(notEmpty());
  command
      .add_option(
          "--ground-blade", request->ground_blade,
          "Number of the blade that the belt is to touch; default: 1, or with --path the blade touched most")
      ->check(wholeNumberFrom(1, kMostBlades));
  command
      .add_option("--max-depth", request->max_depth,
                  "mm that the belt may be pressed into the ground blade: how deep the deepest point of one "
                  "lies in the other; a tool's file may say otherwise")
      ->check(numberFrom(0.0, kMaxLength))
      ->capture_default_str();
  command
      .add_option("--near-miss", request->near_miss,
                  "mm below which a clearance is reported, where the tool's file has no margin for the pair; "
                  "above 0, at most 5")
      ->check(numberFrom(0.0, kMostNearMiss, true))
      ->capture_default_str();
  command
      .add_flag("--continuous,!--poses-only", request->continuous,
                "Check the moves between the poses as well, or the poses alone")
      ->capture_default_str();
  command
      .add_option("--threads", request->threads,
                  "Threads; 0: all that the machine has. The answers are the same")
      ->capture_default_str()
      ->check(wholeNumberFrom(0, 1024));
  command
      .add_option("--frames", request->frames,
                  "Pictures of so many poses along the path: frame_POSE.png, and all on a sheet, frames.png")
      ->capture_default_str()
      ->check(wholeNumberFrom(0, 1000));
  command.add_flag("--no-pictures", request->no_pictures, "Leave the pictures out");
  command.footer(
      "Tables, in OUT; none is written before the end, Ctrl-C keeps the poses done (\"partial\": true):\n"
      "  poses.csv     the verdict of each pose; part, blade, side (forward: towards greater angles), point\n"
      "                and normal of its worst touch, or of where it is nearest, and the part's depth; the\n"
      "                clearance from all that must not be touched; the move from the pose before: free, "
      "hit\n"
      "                (of what neither pose touches), too deep, or not proved, and the fraction that is "
      "free\n"
      "  contacts.csv  contacts, a few of each patch of touch, each with a verdict of its own: triangles,\n"
      "                points and normal in the blisk's frame; the normal points from the part into the\n"
      "                blisk; the depth is that of the pair of triangles alone\n"
      "  summary.json  limits, counts, the poses that interfere\n"
      "  path.csv      the path\n"
      "Blades are numbered from 1 by angle; blade 0 is hub or shroud. Poses and triangles are counted from\n"
      "0. A negative depth is a clearance. Verdicts go by how deep the deepest point of a part lies in the\n"
      "blisk, or of the blisk in the part, to 1 % of --max-depth; of open meshes by what can be told, with\n"
      "a warning. A part wholly inside the blisk is interference. On a move the contact wheel's centre goes\n"
      "straight while the tool turns evenly; coming within 0.001 mm is a hit.\n"
      "Exit codes: 0 no interference at any pose or move, 1 interference found, 2 bad input.");
  command.callback([request, &exit_code] { exit_code = grind(*request); });
}

}  // namespace octoblisk::demos
