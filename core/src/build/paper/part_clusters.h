// Parts of a mesh, each divided into k clusters: the first two steps of the paper's partition.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct PartClusterOptions {
  std::size_t clusters = 2;                ///< k, at least 1, for each part; fewer where it has fewer points
  std::uint64_t seed = 1;                  ///< of k-means
  std::vector<int> part_of_triangle = {};  ///< blade numbers, say; empty: one part
};

/// Indices of triangles, ascending.
using TriangleSet = std::vector<std::uint32_t>;

/// The clusters of each part, by ascending part; no cluster is empty. The points are the triangles' centroids
/// (k_means.h). Throws std::invalid_argument for k = 0, and for parts that are not one a triangle.
std::vector<std::vector<TriangleSet>> partClusters(std::span<const Vec3> centroids,
                                                   const PartClusterOptions& options);

}  // namespace octoblisk::detail
