// The best number of clusters (step 5 of the paper, which gives no criterion; erratum 5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct KOptOptions {
  std::size_t k_max = 8;
  std::size_t leaf_capacity = 8;  ///< the paper's FNOP
  std::uint64_t seed = 1;
};

struct KOpt {
  std::size_t k = 0;               ///< the smallest k of the fewest nodes
  std::vector<std::size_t> nodes;  ///< for k = 2, 3, … k_max
};

/// Clusters the points for each k and divides every cluster by an axis-aligned octree. The best k has the
/// fewest nodes in total (TNON). Throws std::invalid_argument if k_max is not in 2..n.
KOpt optimalK(std::span<const Vec3> points, const KOptOptions& options = {});

}  // namespace octoblisk::detail
