// The best number of clusters (step 5 of the paper, which gives no criterion; erratum 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct KOptOptions {
  std::size_t k_max = 8;
  std::size_t leaf_capacity = 8;  ///< the paper's FNOP
  std::uint64_t seed = 1;
};

/// Clusters the points for each k = 2, 3, … k_max and divides every cluster by an axis-aligned octree.
/// Returns the smallest k of the fewest nodes in total (TNON). Throws std::invalid_argument if k_max is not
/// in 2..n.
std::size_t optimalK(std::span<const Vec3> points, const KOptOptions& options = {});

}  // namespace octoblisk::detail
