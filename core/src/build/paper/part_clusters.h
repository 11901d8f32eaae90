// Parts of a mesh, each divided into k clusters: the first two steps of the paper's partition.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct PartClusterOptions {
  /// k for each part, or fewer if the part has fewer points; 0: the best k for the part (k_opt.h).
  std::size_t clusters = 2;
  std::uint64_t seed = 1;                  ///< for k-means
  std::vector<int> part_of_triangle = {};  ///< e.g. blade numbers; empty: one part
  std::size_t leaf_capacity = 8;           ///< the paper's FNOP, at least 1
};

/// Indices of triangles, ascending.
using TriangleSet = std::vector<std::uint32_t>;

/// The clusters of each part, by ascending part; no cluster is empty. The points are the triangles' centroids
/// (k_means.h). Throws std::invalid_argument if the number of part numbers is not the number of triangles.
std::vector<std::vector<TriangleSet>> partClusters(std::span<const Vec3> centroids,
                                                   const PartClusterOptions& options);

}  // namespace octoblisk::detail
