#include "paper/detection_seeds.h"

#include <nlohmann/json.hpp>

#include "build/paper/principal_box.h"
#include "paper/box_detection.h"
#include "paper/segmentation.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

double secondsOf(const Segmentation& octrees, const Obb& belt_box, std::span<const Pose> poses) {
  const Stopwatch watch;
  for (const Pose& pose : poses) leavesNear(octrees, pose * belt_box, SeparatingAxes::exact15);
  return watch.seconds();
}

/// The improved method's median time divided by the traditional method's; the two are timed alternately.
double timeRatio(const PaperOctrees& octrees, const Obb& belt_box, std::span<const Pose> poses, int runs) {
  std::vector<double> traditional, improved;
  for (int run = 0; run < runs; ++run) {
    traditional.push_back(secondsOf(octrees.traditional, belt_box, poses));
    improved.push_back(secondsOf(octrees.improved, belt_box, poses));
  }
  return medianOf(improved) / medianOf(traditional);
}

double principalRange(std::span<const Points> clusters) {
  double volume = 0.0;
  for (const Points& cluster : clusters) volume += principalBox(cluster).volume();
  return volume;
}

}  // namespace

DetectionSeeds detectionOverSeeds(const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                                  const Obb& belt_box, std::span<const Pose> belt_in_blisk,
                                  const DetectionSeedOptions& options, const Progress& progress) {
  DetectionSeeds seeds;
  for (std::size_t i = 0; i < options.count; ++i) {
    KMeansOptions k_means = options.k_means;
    k_means.seed += i;
    const PaperOctrees octrees(parts_of_seed(k_means.seed), k_means, options.fnop);
    const double traditional = octrees.traditional.rootVolume();
    seeds.range.push_back(octrees.improved.rootVolume() / traditional);
    seeds.principal_range.push_back(principalRange(octrees.clusters) / traditional);
    seeds.seconds.push_back(timeRatio(octrees, belt_box, belt_in_blisk, options.runs));
    progress(static_cast<double>(i + 1) / static_cast<double>(options.count));
  }
  return seeds;
}

void to_json(nlohmann::json& json, const DetectionSeeds& seeds) {
  json = {{"range", seeds.range}, {"principal_range", seeds.principal_range}, {"seconds", seeds.seconds}};
}

}  // namespace octoblisk::demos
