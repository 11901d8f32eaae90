// Tables 3 and 4 over many seeds: how much of a change is the method's, how much the seed's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "build/paper/k_means.h"
#include "paper/claims.h"
#include "paper/paper_model.h"
#include "paper/progress.h"
#include "paper/published.h"
#include "paper/spread.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The improved method against the traditional one, as ratios, one entry a seed.
struct DetectionSeeds {
  std::vector<double> range;            ///< boxes along the axes, as the paper's
  std::vector<double> principal_range;  ///< boxes along the principal axes of each cluster
  std::vector<double> seconds;          ///< to detect at all poses: medians of interleaved runs

  std::size_t count() const { return range.size(); }
};

struct DetectionSeedOptions {
  std::size_t count = 32;  ///< seeds: those of `k_means`, counted on
  std::size_t fnop = 2;
  detail::KMeansOptions k_means{};
  int runs = 5;  ///< of each method, in turn
};

/// `parts_of_seed` gives the clouds of the blisk's parts. The belt is its one box, in the belt's frame.
/// Deterministic but for the times.
DetectionSeeds detectionOverSeeds(const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                                  const Obb& belt_box, std::span<const Pose> belt_in_blisk,
                                  const DetectionSeedOptions& options, const Progress& progress);

/// Rows: the ranges and the time; mean, least and most of their changes.
Table seedsTable(std::string name, const std::string& of, const DetectionSeeds& seeds);

/// A sentence: the mean changes and whether the spread leaves their signs open.
std::string seedsVerdict(const DetectionSeeds& seeds);

/// The change of the range, and of the time.
std::vector<Claim> seedsClaims(const std::string& table, const DetectionSeeds& seeds,
                               const DetectionTable& paper);

}  // namespace octoblisk::demos
