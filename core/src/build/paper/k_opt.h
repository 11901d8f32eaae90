// The best number of clusters (step 5 of the paper, which gives no criterion; erratum 5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

enum class KCriterion {
  least_nodes,  ///< paper mode: axis-aligned octrees over the clusters with the fewest nodes in total (TNON)
  least_leaf_volume,  ///< ours: octrees in the clusters' principal frames with the least leaf volume
};

struct KOptOptions {
  std::size_t k_min = 2;
  std::size_t k_max = 8;
  KCriterion criterion = KCriterion::least_nodes;
  std::size_t leaf_capacity = 8;  ///< the paper's FNOP
  std::uint64_t seed = 1;
};

struct KOpt {
  std::size_t k = 0;         ///< the smallest k of the least cost
  std::vector<double> cost;  ///< for k_min, k_min + 1, … k_max: nodes, or mesh units cubed
};

/// Clusters the points for each k and divides every cluster by an octree. Throws std::invalid_argument if
/// k_min..k_max is empty or not within 1..n.
KOpt optimalK(std::span<const Vec3> points, const KOptOptions& options = {});

}  // namespace octoblisk::detail
