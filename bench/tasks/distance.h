// The distance of belt and blisk at the clear poses of the path, in order.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "mean_cost.h"
#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

/// The distances at the clear poses. The reference computes every kEvery-th one, if it is no more than
/// kFarthest. The others are the smaller of OctoBlisk's and, if it takes part, FCL's answer: a search that
/// skips too much errs upwards.
struct Distances {
  static constexpr std::size_t kEvery = 30;
  static constexpr double kFarthest = 3.0;              // mm
  static constexpr std::size_t kMaxForFcl = 2'000'000;  // triangles; FCL takes more than 500 bytes for each

  std::vector<Pose> poses;
  std::vector<double> truth;
  std::size_t by_reference = 0;  ///< number of distances that the reference computed
};

inline Distances findDistances(const Scene& scene) {
  Distances found;
  const Truth& touching = truthOf(scene, scene.path);
  for (std::size_t k = 0; k < scene.path.size(); ++k) {
    if (touching.touching_pairs[k] == 0) found.poses.push_back(scene.path[k]);
  }
  found.truth.assign(found.poses.size(), std::numeric_limits<double>::infinity());
  for (const Contender& contender : contenders()) {
    if (!contender.distance || (contender.name != kOurs && contender.name != "fcl")) continue;
    if (contender.name == "fcl" && scene.blisk->triangleCount() > Distances::kMaxForFcl) continue;
    const std::unique_ptr<DistanceQuery> query = contender.distance(scene);
    for (std::size_t k = 0; k < found.poses.size(); ++k) {
      found.truth[k] = std::min(found.truth[k], query->distance(found.poses[k], false));
    }
  }
  const Reference reference(*scene.blisk);
  for (std::size_t k = 0; k < found.poses.size(); k += Distances::kEvery) {
    if (const auto distance = reference.distance(Distances::kFarthest, *scene.belt, found.poses[k])) {
      found.truth[k] = *distance;
      ++found.by_reference;
    }
  }
  return found;
}

/// The distances at the clear poses of the scene's path, computed at the first call for a scene and cached.
inline const Distances& distancesOf(const Scene& scene) {
  static std::map<const Scene*, Distances> known;
  const auto entry = known.find(&scene);
  return entry != known.end() ? entry->second : known.emplace(&scene, findDistances(scene)).first->second;
}

inline TimedTask distanceTask(const std::string& name, bool warm) {
  const auto prepare = [warm](const Scene& scene, const Contender& contender) {
    constexpr double kTolerance = 1e-6;  // relative
    const std::shared_ptr<DistanceQuery> query = contender.distance(scene);
    const Distances& distances = distancesOf(scene);
    std::size_t differences = 0;
    for (std::size_t k = 0; k < distances.poses.size(); ++k) {
      const double truth = distances.truth[k];
      // NaN counts as a difference too.
      differences += !(std::abs(query->distance(distances.poses[k], warm) - truth) <= kTolerance * truth);
    }
    std::vector<double> sorted = distances.truth;
    std::ranges::sort(sorted);
    Trial trial{
        .questions = distances.poses.size(),
        .ask = [query, warm, &distances](
                   std::size_t k) { benchmark::DoNotOptimize(query->distance(distances.poses[k], warm)); },
        .differences = differences,
        .counters = {{"by_reference", static_cast<double>(distances.by_reference)},
                     {"median_distance", sorted[sorted.size() / 2]},
                     {"greatest_distance", sorted.back()}}};
    trial.counters.merge(meanCost(*query, distances.poses));
    return trial;
  };
  return {name, [](const Contender& contender) { return static_cast<bool>(contender.distance); }, prepare};
}

}  // namespace octoblisk::bench
