// The first triangle that random segments hit.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mean_cost.h"
#include "reference.h"
#include "timed_task.h"

namespace octoblisk::bench {

/// The reference's first hits, computed at the first call for a scene and cached.
inline const std::vector<double>& firstHitsOf(const Scene& scene) {
  static std::map<const Scene*, std::vector<double>> known;
  const auto [entry, is_new] = known.try_emplace(&scene);
  if (is_new) {
    const Reference reference(*scene.blisk);
    for (const Segment& segment : scene.segments) entry->second.push_back(reference.firstHit(segment));
  }
  return entry->second;
}

/// Runs `query`, one of the contender's queries, for every `one_in`-th segment.
template <typename Query>
Trial rayTrial(const std::shared_ptr<Query>& query, const Scene& scene, std::size_t one_in = 1) {
  constexpr double kTolerance = 1e-4;  // relative to the segment: single precision on slanted triangles
  constexpr std::size_t kBundle = 100;
  const std::vector<double>& truth = firstHitsOf(scene);
  const std::size_t segments = scene.segments.size() / one_in;
  std::size_t differences = 0;
  for (std::size_t k = 0; k < segments; ++k) {
    differences += !(std::abs(query->firstHit(scene.segments[k]) - truth[k]) <= kTolerance);
  }
  const auto hits = std::count_if(truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(segments),
                                  [](double part) { return part < 1.0; });
  const auto ask = [query, &scene](std::size_t bundle) {
    for (std::size_t k = bundle * kBundle; k < (bundle + 1) * kBundle; ++k) {
      benchmark::DoNotOptimize(query->firstHit(scene.segments[k]));
    }
  };
  std::map<std::string, double> counters;
  if constexpr (std::same_as<Query, RayQuery>) counters = meanCost(*query, scene.segments);
  counters["hit_rate"] = static_cast<double>(hits) / static_cast<double>(segments);
  return {.questions = segments / kBundle,
          .asked_at_once = kBundle,
          .ask = ask,
          .differences = differences,
          .counters = std::move(counters)};
}

inline TimedTask rayTask(const std::string& name) {
  const auto prepare = [](const Scene& scene, const Contender& contender) {
    return rayTrial(std::shared_ptr<RayQuery>(contender.ray(scene)), scene);
  };
  return {name, [](const Contender& contender) { return static_cast<bool>(contender.ray); }, prepare};
}

}  // namespace octoblisk::bench
