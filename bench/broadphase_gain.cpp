// Measures what ClusteredOctreeBroadphase saves against btDbvtBroadphase: the collision detection range
// (Table 3 of the paper), and, in a grinding world, the pairs, the active islands and the time of a step.
//
//   broadphase_gain [rows = broadphase.json] [blisk file...]
//
// Always measures the default blisk, and also the given meshes (mm, axis Z). Prints tables and writes their
// rows. The file's rows of other blisks stay.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <stdexcept>

#include "detection_range.h"
#include "grinding_world.h"
#include "io/mesh_file.h"
#include "models/embedded_assets.h"
#include "models/orientation.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "report/rows.h"

namespace octoblisk::bench {

namespace {

/// Volumes in mm³, and the fraction that they save against one box around everything.
void addRanges(const GrindingScene& scene, Rows& rows) {
  constexpr std::size_t kMaxClusters = 8;
  constexpr int kMaxDepth = 6;
  const TriangleMesh& mesh = scene.blisk->mesh();
  const double one_box = 8.0 * mesh.bounds().halfExtents().prod();
  std::printf("\n%s: collision detection range; the single axis-aligned box has %.4g mm3\n",
              scene.name.c_str(), one_box);
  std::printf("%-24s%8s%8s%16s%10s%16s%10s\n", "divided into", "k", "boxes", "axis-aligned", "saved",
              "oriented", "saved");
  const std::pair<const char*, std::vector<int>> divisions[] = {{"one part", {}},
                                                                {"blades and hub", scene.blade_of_triangle}};
  for (const auto& [division, parts] : divisions) {
    for (std::size_t k = 1; k <= kMaxClusters; ++k) {
      const DetectionRange range = detectionRange(mesh, {.clusters = k, .part_of_triangle = parts});
      const double aligned = range.axisAlignedVolume(), oriented = range.orientedVolume();
      std::printf("%-24s%8zu%8zu%16.4g%9.1f%%%16.4g%9.1f%%\n", division, k, range.oriented.size(), aligned,
                  100.0 * (1.0 - aligned / one_box), oriented, 100.0 * (1.0 - oriented / one_box));
      rows.push_back({{"task", "broadphase-range"},
                      {"scene", scene.name},
                      {"division", division},
                      {"k", k},
                      {"boxes", range.oriented.size()},
                      {"one_box_mm3", one_box},
                      {"axis_aligned_mm3", aligned},
                      {"axis_aligned_saved", 1.0 - aligned / one_box},
                      {"oriented_mm3", oriented},
                      {"oriented_saved", 1.0 - oriented / one_box}});
    }
  }
  for (int depth = 0; depth <= kMaxDepth; ++depth) {
    const std::vector<Obb> boxes = scene.blisk->boxes(depth);
    double volume = 0.0;
    for (const Obb& box : boxes) volume += box.volume();
    const bool is_default = depth == ClusteredOctreeBroadphase::kDefaultDepth;
    std::printf("%-24s%8s%8zu%16s%10s%16.4g%9.1f%%\n",
                ("depth " + std::to_string(depth) + (is_default ? " (default)" : "")).c_str(), "",
                boxes.size(), "", "", volume, 100.0 * (1.0 - volume / one_box));
    rows.push_back({{"task", "broadphase-range"},
                    {"scene", scene.name},
                    {"division", "ClusteredOctreeBroadphase"},
                    {"depth", depth},
                    {"boxes", boxes.size()},
                    {"one_box_mm3", one_box},
                    {"oriented_mm3", volume},
                    {"oriented_saved", 1.0 - volume / one_box}});
  }
}

/// One drive along the path. The figures are means over its steps.
struct Drive {
  double step_us = 0.0;  ///< processor time
  double pairs = 0.0, awake_islands = 0.0, awake_bodies = 0.0, tool_points = 0.0;
  double blisk_turned = 0.0;       ///< at the end, degrees
  std::vector<int> tool_contacts;  ///< of each step
};

Drive drive(const GrindingScene& scene, Mount mount, btBroadphaseInterface& broadphase) {
  GrindingWorld world(scene, mount, broadphase);
  Drive sum;
  const double count = static_cast<double>(scene.tool_in_blisk.size());
  for (const Pose& pose : scene.tool_in_blisk) {
    const std::clock_t begin = std::clock();
    world.step(pose);
    sum.step_us += 1e6 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / count;
    sum.pairs += world.pairs() / count;
    sum.awake_islands += world.awakeIslands() / count;
    sum.awake_bodies += world.awakeBodies() / count;
    sum.tool_contacts.push_back(world.toolContacts());
    sum.tool_points += sum.tool_contacts.back() / count;
  }
  sum.blisk_turned = world.bliskTurned();
  return sum;
}

/// Takes the median of the drives' times. All other figures are the same in every drive.
template <typename Broadphase>
struct Contender {
  void driveOnce(const GrindingScene& scene, Mount mount) {
    Broadphase broadphase;
    last = drive(scene, mount, broadphase);
    times.push_back(last.step_us);
    std::ranges::sort(times);
  }
  double time() const { return times[times.size() / 2]; }

  Drive last;
  std::vector<double> times;
};

void addWorlds(const GrindingScene& scene, Rows& rows) {
  constexpr int kDrives = 3;
  std::printf("\n%s: %zu steps of the tool along its path, %zu loose bodies; means per step\n",
              scene.name.c_str(), scene.tool_in_blisk.size(), scene.loose.size());
  std::printf("%-12s%-24s%10s%16s%16s%16s%12s%12s%10s\n", "blisk", "broadphase", "pairs", "islands awake",
              "bodies awake", "tool's points", "blisk turned", "us", "ratio");
  const std::pair<const char*, Mount> mounts[] = {
      {"clamped", Mount::clamped}, {"table", Mount::table}, {"spindle", Mount::spindle}};
  for (const auto& [name, mount] : mounts) {
    Contender<ClusteredOctreeBroadphase> ours;
    Contender<btDbvtBroadphase> stock;
    for (int turn = 0; turn < kDrives; ++turn) {
      if (turn % 2 == 0) ours.driveOnce(scene, mount);
      stock.driveOnce(scene, mount);
      if (turn % 2 == 1) ours.driveOnce(scene, mount);
    }
    int differences = 0;
    for (std::size_t step = 0; step < scene.tool_in_blisk.size(); ++step)
      differences += ours.last.tool_contacts[step] != stock.last.tool_contacts[step];
    const auto add = [&](const char* broadphase, const Drive& means, double time) {
      std::printf("%-12s%-24s%10.1f%16.1f%16.1f%16.1f%12.2f%12.1f%10.2f\n", name, broadphase, means.pairs,
                  means.awake_islands, means.awake_bodies, means.tool_points, means.blisk_turned, time,
                  time / ours.time());
      rows.push_back({{"task", "broadphase-world"},
                      {"scene", scene.name + ", " + name},
                      {"contender", broadphase},
                      {"mean_us", time},
                      {"ratio", time / ours.time()},
                      {"answers_equal", differences == 0},
                      {"differences", differences},
                      {"pairs", means.pairs},
                      {"islands_awake", means.awake_islands},
                      {"bodies_awake", means.awake_bodies},
                      {"tool_points", means.tool_points},
                      {"blisk_turned_deg", means.blisk_turned},
                      {"questions", scene.tool_in_blisk.size()},
                      {"passes", kDrives}});
    };
    add("ClusteredOctreeBroadphase", ours.last, ours.time());
    add("btDbvtBroadphase", stock.last, stock.time());
    if (differences > 0)
      std::printf("%-12sat %d steps the tool has a different number of contact points\n", "", differences);
  }
}

TriangleMesh readOutward(const char* file) {
  TriangleMesh mesh = demos::readMesh(file);
  return demos::enclosedVolume(mesh) >= 0.0 ? mesh : demos::turned(mesh);
}

int run(int argc, char** argv) {
  if (argc > 1 && argv[1][0] == '-')
    throw std::runtime_error("usage: broadphase_gain [rows] [blisk file...]");
  Rows rows;
  const auto report = [&](const GrindingScene& scene) {
    addRanges(scene, rows);
    addWorlds(scene, rows);
  };
  report(makeGrindingScene("default", demos::embeddedBlisk()));
  for (int i = 2; i < argc; ++i)
    report(makeGrindingScene(std::filesystem::path(argv[i]).stem().string(), readOutward(argv[i])));
  const char* file = argc > 1 ? argv[1] : "broadphase.json";
  addRows(file, rows);
  return 0;
}

}  // namespace
}  // namespace octoblisk::bench

int main(int argc, char** argv) {
  try {
    return octoblisk::bench::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "broadphase_gain: %s\n", error.what());
    return 2;
  }
}
