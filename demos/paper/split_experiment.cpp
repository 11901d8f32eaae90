#include "paper/split_experiment.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "paper/box_detection.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

using Clusters = std::vector<Points>;

SplitCell measured(const Segmentation& segmentation, const Obb& belt_box, std::span<const BeltPose> poses) {
  SplitCell cell;
  cell.nodes = segmentation.totalNodes();
  cell.leaf_volume = segmentation.leafVolume();
  for (const BeltPose& pose : poses) {
    const bool called = anyLeafNear(segmentation, pose.belt_in_mesh * belt_box);
    cell.false_positives += called && !pose.touches;
    cell.false_negatives += !called && pose.touches;
  }
  return cell;
}

/// The median time of building each cell's octrees. All cells are timed in turn, repeatedly, so that a
/// disturbance of the machine affects all of them.
void timeSplits(const std::array<Clusters, kMethods>& clusters, int repeats, SplitResult& result,
                const Progress& progress) {
  MethodTable<std::array<std::vector<double>, 2>> times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      for (std::size_t method = 0; method < kMethods; ++method) {
        for (const bool principal : {false, true}) {
          const Stopwatch watch;
          const Segmentation segmentation(clusters[method], fnopOf(column),
                                          principal ? CellFrame::principal_box : CellFrame::cube);
          times[method][column][principal].push_back(1e3 * watch.seconds());
        }
      }
    }
    progress(static_cast<double>(repeat + 1) / repeats);
  }
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      result.cubes[method][column].split_ms = medianOf(times[method][column][0]);
      result.principal[method][column].split_ms = medianOf(times[method][column][1]);
    }
  }
}

}  // namespace

void to_json(nlohmann::json& json, const SplitCell& cell) {
  json = {{"nodes", cell.nodes},
          {"split_ms", cell.split_ms},
          {"leaf_volume", cell.leaf_volume},
          {"false_positives", cell.false_positives},
          {"false_negatives", cell.false_negatives}};
}

void to_json(nlohmann::json& json, const SplitResult& result) {
  json = {{"cubes", result.cubes},
          {"principal", result.principal},
          {"cluster_ms", result.cluster_ms},
          {"touching", result.touching},
          {"clear", result.clear}};
}

SplitResult runSplitExperiment(const Points& cloud, const Obb& belt_box, std::span<const BeltPose> poses,
                               const SplitOptions& options, const Progress& progress) {
  SplitResult result;
  for (const BeltPose& pose : poses) ++(pose.touches ? result.touching : result.clear);

  std::array<Clusters, kMethods> clusters;
  for (std::size_t method = 0; method < kMethods; ++method) {
    KMeansOptions k_means = options.k_means;
    k_means.k = clustersOfMethod(method);
    std::vector<double> times;
    for (int repeat = 0; repeat < std::min(options.repeats, 3); ++repeat) {
      const Stopwatch watch;
      clusters[method] = clustersOf(cloud, k_means);
      times.push_back(1e3 * watch.seconds());
    }
    if (method > 0) result.cluster_ms[method] = medianOf(times);
  }
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      const std::size_t fnop = fnopOf(column);
      result.cubes[method][column] =
          measured(Segmentation(clusters[method], fnop, CellFrame::cube), belt_box, poses);
      result.principal[method][column] =
          measured(Segmentation(clusters[method], fnop, CellFrame::principal_box), belt_box, poses);
    }
    progress(0.5 * static_cast<double>(method + 1) / kMethods);
  }
  timeSplits(clusters, options.repeats, result, stretchOf(progress, 0.5, 1.0));
  return result;
}

}  // namespace octoblisk::demos
