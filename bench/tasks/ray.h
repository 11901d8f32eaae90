// The first triangle that random segments hit.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <map>
#include <memory>
#include <span>
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
  const std::size_t bundles = scene.segments.size() / one_in / kBundle;
  const auto firstHits = [query, &scene](std::size_t bundle) {
    const auto segments = std::span(scene.segments).subspan(bundle * kBundle, kBundle);
    std::array<double, kBundle> fractions;
    if constexpr (std::same_as<Query, RayQuery>) {
      query->firstHits(segments, fractions);
    } else {
      std::ranges::transform(segments, fractions.begin(),
                             [&](const Segment& segment) { return query->firstHit(segment); });
    }
    return fractions;
  };
  std::size_t differences = 0, hits = 0;
  for (std::size_t bundle = 0; bundle < bundles; ++bundle) {
    const std::array<double, kBundle> found = firstHits(bundle);
    for (std::size_t k = 0; k < kBundle; ++k) {
      const double expected = truth[bundle * kBundle + k];
      differences += !(std::abs(found[k] - expected) <= kTolerance);
      hits += expected < 1.0;
    }
  }
  const auto ask = [firstHits](std::size_t bundle) { benchmark::DoNotOptimize(firstHits(bundle)); };
  std::map<std::string, double> counters;
  if constexpr (std::same_as<Query, RayQuery>) counters = meanCost(*query, scene.segments);
  counters["hit_rate"] = static_cast<double>(hits) / static_cast<double>(bundles * kBundle);
  return {.questions = bundles,
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
