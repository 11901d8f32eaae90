// octoblisk grind: moves the belt grinder along a path and tells what touches what.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <sstream>

#include "cell/grinding_cell.h"
#include "cell/part_depths.h"
#include "cell/reduce_contacts.h"
#include "cell/verdict.h"
#include "commands/commands.h"
#include "commands/option_checks.h"
#include "models/belt_grinder.h"
#include "models/blade_finder.h"
#include "models/embedded_assets.h"
#include "models/length_limit.h"
#include "models/mesh_file.h"
#include "models/open_edges.h"
#include "models/orientation.h"
#include "models/shared_tree.h"
#include "report/grinding_pictures.h"
#include "report/grinding_report.h"
#include "report/progress_bar.h"
#include "toolpath/grinding_path.h"
#include "toolpath/path_file.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

constexpr int kMostBlades = 10'000;
constexpr int kMostNearMiss = 5;  // mm; the pairs of triangles within reach grow with its square

struct GrindRequest {
  std::string blisk, belt, path;  // files; empty: the defaults
  std::string out;
  std::optional<int> ground_blade;
  double max_depth = 0.1;  // mm
  double near_miss = 0.5;  // mm
  bool no_pictures = false;
};

std::string nameOfBlisk(const GrindRequest& request) {
  return request.blisk.empty() ? "the blisk" : request.blisk;
}

/// A mesh of the user's, facing outward: depths and normals are measured along the triangles' outward
/// normals.
TriangleMesh readOutward(const std::string& file) {
  TriangleMesh mesh = readMesh(file);
  if (enclosedVolume(mesh) >= 0.0) return mesh;
  std::cout << file << ": its triangles face inward; they are taken turned round\n";
  return turned(mesh);
}

/// The whole default grinder, or the user's belt alone: the default wheels and arm need not fit it.
std::vector<ToolPart> toolParts(const std::string& belt_file) {
  std::vector<ToolPart> parts;
  if (!belt_file.empty()) {
    parts.push_back({"belt", treeOf(readOutward(belt_file))});
    return parts;
  }
  for (EmbeddedPart& part : embeddedBeltGrinder()) {
    parts.push_back({std::move(part.name), treeOf(std::move(part.mesh))});
  }
  return parts;
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

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

void movePath(GrindingCell& cell, const std::vector<Pose>& path, const BladesFound& blades,
              GrindingRun& run) {
  ProgressBar progress(std::cerr, path.size());
  Seconds spent{};
  for (const Pose& pose : path) {
    const auto start = Clock::now();
    const std::vector<PartContact> all = cell.contactsAt(pose);
    spent += Clock::now() - start;
    PoseReport report;
    report.tool_in_blisk = pose;
    report.contacts = reduceContacts(all, blades.blade_of_triangle);
    for (const PartContact& found : report.contacts) {
      report.blades.push_back(blades.blade_of_triangle[found.contact.triangle_a]);
    }
    run.poses.push_back(std::move(report));
    progress.update(run.poses.size());
  }
  run.contact_seconds_a_pose = spent.count() / static_cast<double>(path.size());
}

/// How deep the parts are at each pose: as solids, or by pairs of triangles where there are none.
void measureDepths(PartDepths& depths, const std::vector<Pose>& path, GrindingRun& run) {
  constexpr std::size_t kAtOnce = 16;  // for the progress bar's sake
  ProgressBar progress(std::cerr, path.size());
  const auto start = Clock::now();
  for (std::size_t begin = 0; begin < path.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, path.size() - begin);
    std::vector<std::vector<PartDepth>> found = depths.measure(std::span(path).subspan(begin, count));
    for (std::size_t i = 0; i < count; ++i) run.poses[begin + i].depths = std::move(found[i]);
    progress.update(begin + count);
  }
  run.depth_seconds_a_pose = Seconds(Clock::now() - start).count() / static_cast<double>(path.size());
  for (PoseReport& pose : run.poses) {
    for (const PartDepth& deepest : depthsOfPairs(pose.contacts)) {
      if (run.depth_kinds[deepest.part] == DepthKind::of_pairs) pose.depths.push_back(deepest);
    }
    for (const PartDepth& deepest : pose.depths) {
      pose.depth_blades.push_back(run.blade_of_triangle[deepest.triangle_of_blisk]);
    }
  }
}

/// Refuses to write a table over a file that is read; path.csv is kept where it is the path read.
void requireNoInputAmongTables(const GrindRequest& request) {
  for (const char* table : {"poses.csv", "contacts.csv", "summary.json"}) {
    const std::filesystem::path file = std::filesystem::path(request.out) / table;
    std::error_code ignored;  // mostly there is no such file
    if (std::filesystem::equivalent(request.path, file, ignored)) {
      throw std::runtime_error(file.string() + ": cannot be both read and written");
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
  const std::string open_belt = request.belt.empty() ? "the belt grinder" : request.belt;
  if (is_of(DepthKind::of_part)) {
    warn(open_belt, describe(openEdges(run.parts.front().tree->mesh())) +
                        ": its depth is that of its surface in the blisk");
  }
  if (is_of(DepthKind::of_pairs)) {
    warn(nameOfBlisk(request),
         describe(openEdges(run.blisk->mesh())) +
             ", so it is no solid: depths are those of pairs of triangles, which shrink as meshes get finer, "
             "and a part wholly inside goes unnoticed");
  }
}

/// "poses 20-79, 228": the runs that interfere, the first of them where they are many.
std::string listOf(const std::vector<PoseRange>& ranges) {
  constexpr std::size_t kMost = 12;
  std::ostringstream text;
  text << "poses ";
  for (std::size_t i = 0; i < std::min(ranges.size(), kMost); ++i) {
    text << (i > 0 ? ", " : "") << ranges[i].first;
    if (ranges[i].last != ranges[i].first) text << '-' << ranges[i].last;
  }
  if (ranges.size() > kMost) text << " and " << ranges.size() - kMost << " more runs (summary.json)";
  return text.str();
}

void tell(const GrindingRun& run, const std::filesystem::path& out, bool pictures) {
  const int blade = run.rules.ground_blade;
  const std::string blades = std::to_string(run.blade_count);
  std::cout << run.poses.size() << (run.poses.size() == 1 ? " pose, " : " poses, ");
  if (blade == 0) {
    std::cout << "no blade ground (the blisk has " << blades << ")";
  } else {
    std::cout << "ground blade " << blade << " of " << blades << " (intended up to " << run.rules.max_depth
              << " mm deep)";
  }
  std::cout << ": " << run.count(Verdict::clear) << " clear, " << run.count(Verdict::intended_contact)
            << " intended contact, " << run.count(Verdict::near_miss) << " near miss, "
            << run.count(Verdict::interference) << " interference\n";
  const PoseReport& shown = run.poses[poseToShow(run)];
  if (shown.verdict == Verdict::interference) {
    std::cout << "Interference at " << listOf(interferingRanges(run)) << ", counted from 0\n";
    std::cout << "Worst: pose " << poseToShow(run) << ", " << describeWorst(run, shown) << '\n';
  }
  std::cout << "Tables: " << (out / "poses.csv").string() << ", " << (out / "contacts.csv").string() << ", "
            << (out / "summary.json").string() << ", " << (out / "path.csv").string() << '\n';
  if (pictures) {
    std::cout << "Pictures: " << (out / "overview.png").string() << ", " << (out / "closeup.png").string()
              << '\n';
  }
}

int grind(const GrindRequest& request) {
  requireNoInputAmongTables(request);
  const std::filesystem::path out = request.out;
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw std::runtime_error(request.out + ": the folder cannot be made: " + error.message());

  GrindingRun run;
  run.blisk_name = request.blisk.empty() ? "default" : request.blisk;
  run.belt_name = request.belt.empty() ? "default" : request.belt;
  run.path_name = request.path.empty() ? "generated" : request.path;
  run.blisk = treeOf(request.blisk.empty() ? embeddedBlisk() : readOutward(request.blisk));
  run.parts = toolParts(request.belt);
  run.near_miss = request.near_miss;
  const BladesFound blades = findBlades(run.blisk->mesh());
  run.blade_count = blades.count;
  run.blade_of_triangle = blades.blade_of_triangle;
  if (request.ground_blade && (*request.ground_blade < 1 || *request.ground_blade > blades.count)) {
    throw std::invalid_argument("--ground-blade " + std::to_string(*request.ground_blade) +
                                ": the blisk has " + std::to_string(blades.count) +
                                " blades, numbered from 1");
  }
  const std::vector<Pose> path = pathOf(request, *run.blisk, blades);
  PartDepths depths(run.blisk, run.parts, request.max_depth);
  for (std::size_t part = 0; part < run.parts.size(); ++part) run.depth_kinds.push_back(depths.kindOf(part));
  warnOf(request, run, blades);
  const bool is_input = std::filesystem::equivalent(request.path, out / "path.csv", error);
  if (!is_input) writePoses(out / "path.csv", path);

  GrindingCell cell(run.blisk, run.parts, request.near_miss);
  movePath(cell, path, blades, run);
  measureDepths(depths, path, run);
  const int default_blade = request.path.empty() ? 1 : mostTouchedBlade(run.poses, run.rules.grinding_part);
  run.rules.ground_blade = request.ground_blade.value_or(default_blade);
  run.rules.max_depth = request.max_depth;
  judge(run.poses, run.rules);

  writePoseVerdicts(run, out / "poses.csv");
  writeContacts(run, out / "contacts.csv");
  writeSummary(run, out / "summary.json");
  if (!request.no_pictures) writePictures(run, out);
  tell(run, out, !request.no_pictures);
  return run.count(Verdict::interference) > 0 ? 1 : 0;
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
                  "lies in the "
                  "other")
      ->check(numberFrom(0.0, kMaxLength))
      ->capture_default_str();
  command
      .add_option("--near-miss", request->near_miss,
                  "mm below which a clearance is reported; above 0, at most " + std::to_string(kMostNearMiss))
      ->check(numberFrom(0.0, kMostNearMiss, true))
      ->capture_default_str();
  command.add_flag("--no-pictures", request->no_pictures, "Leave the pictures out");
  command.footer(
      "Tables, in OUT:\n"
      "  poses.csv     the verdict of each pose, with part and blade of its worst touch and the part's "
      "depth\n"
      "  contacts.csv  contacts, a few of each patch of touch, each with a verdict of its own: triangles,\n"
      "                points and normal in the blisk's frame; the normal points from the part into the\n"
      "                blisk; the depth is that of the pair of triangles alone\n"
      "  summary.json  limits, counts, the poses that interfere\n"
      "  path.csv      the path\n"
      "Blades are numbered from 1 by angle; blade 0 is hub or shroud. Poses and triangles are counted from\n"
      "0. A negative depth is a clearance. Verdicts go by how deep the deepest point of a part lies in the\n"
      "blisk, or of the blisk in the part, to 1 % of --max-depth; of open meshes by what can be told, with "
      "a\n"
      "warning. A part wholly inside the blisk is interference.\n"
      "Exit codes: 0 no interference, 1 interference found, 2 bad input.");
  command.callback([request, &exit_code] { exit_code = grind(*request); });
}

}  // namespace octoblisk::demos
