// How the whole blisk's cloud is best divided: by k-means at once, or into its parts first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paper/segmentation.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Volumes of the boxes that a way of dividing begins with, mm³: the collision detection range. The boxes are
/// of points, as the paper's are; those of the library's detectionRange hold whole triangles.
struct BliskRange {
  std::size_t k = 0;          ///< clusters of the whole, or of each part
  std::size_t boxes = 0;      ///< how many there are
  double axis_aligned = 0.0;  ///< boxes along the axes
  double principal = 0.0;     ///< boxes along the principal axes of each
};

struct BliskRanges {
  BliskRange whole;                  ///< one box
  std::vector<BliskRange> at_once;   ///< k-means over the whole blisk, k = 2..8
  std::vector<BliskRange> by_parts;  ///< parts first (blades, hub), then k clusters of each, k = 1..8
};

/// Of the parts' clouds, each of at least 8 points; k of the options is not asked.
BliskRanges findBliskRanges(std::span<const Points> parts, const detail::KMeansOptions& k_means);

/// What the report says of it.
Section bliskRangesSection(const BliskRanges& ranges, std::size_t blades);

}  // namespace octoblisk::demos
