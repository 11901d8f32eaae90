// Tables 3 and 4 over many seeds: separates the effect of the method from that of the seed.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "build/paper/k_means.h"
#include "paper/paper_model.h"
#include "paper/progress.h"

namespace octoblisk::demos {

/// Ratios of the improved method to the traditional one, one entry per seed.
struct DetectionSeeds {
  std::vector<double> range;            ///< boxes along the axes, as the paper's
  std::vector<double> principal_range;  ///< boxes along the principal axes of each cluster
  std::vector<double> seconds;          ///< to detect at all poses: medians of interleaved runs

  std::size_t count() const { return range.size(); }
};

struct DetectionSeedOptions {
  std::size_t count = 32;  ///< seeds, counted up from that of `k_means`
  std::size_t fnop = 2;
  detail::KMeansOptions k_means{};
  int runs = 5;  ///< of each method, alternately
};

/// `parts_of_seed` gives the clouds of the blisk's parts. The belt is represented by its one box, in the
/// belt's frame. Deterministic except for the times.
DetectionSeeds detectionOverSeeds(const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                                  const Obb& belt_box, std::span<const Pose> belt_in_blisk,
                                  const DetectionSeedOptions& options, const Progress& progress);

void to_json(nlohmann::json& json, const DetectionSeeds& seeds);

}  // namespace octoblisk::demos
