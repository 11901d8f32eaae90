// The paper's partition of a mesh: parts, each divided into k clusters, each cluster by an octree in its
// principal frame.
#pragma once

#include <span>

#include "build/paper/part_clusters.h"
#include "build/partition.h"

namespace octoblisk::detail {

struct PaperPartitionOptions {
  int leaf_capacity = 8;  ///< FNOP, at least 1; a leaf of more than 8 triangles becomes several leaves
  PartClusterOptions parts = {};  ///< k: 1..8
};

/// The paper's partition over the triangles' centroids.
Partition paperPartition(std::span<const TriangleRecord> records, const PaperPartitionOptions& options);

}  // namespace octoblisk::detail
