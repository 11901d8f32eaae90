// Compares ways to divide the whole blisk's cloud: by k-means at once, or into its parts first.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "paper/segmentation.h"

namespace octoblisk::demos {

/// Volumes of the boxes with which a detection begins, mm³: the collision detection range. Like the paper's,
/// the boxes enclose points; those of the library's detectionRange enclose whole triangles.
struct BliskRange {
  std::size_t k = 0;          ///< clusters of the whole, or per part
  std::size_t boxes = 0;      ///< number of boxes
  double axis_aligned = 0.0;  ///< boxes along the axes
  double principal = 0.0;     ///< boxes along the principal axes of each
};

struct BliskRanges {
  BliskRange whole;                  ///< one box
  std::vector<BliskRange> at_once;   ///< k-means over the whole blisk, k = 2..8
  std::vector<BliskRange> by_parts;  ///< parts first (blades, hub), then k clusters of each, k = 1..8
};

/// `parts` are the parts' clouds, each with at least 8 points; the k of the options is ignored.
BliskRanges findBliskRanges(std::span<const Points> parts, const detail::KMeansOptions& k_means);

void to_json(nlohmann::json& json, const BliskRange& range);
void to_json(nlohmann::json& json, const BliskRanges& ranges);

}  // namespace octoblisk::demos
