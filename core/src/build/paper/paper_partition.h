// The paper's partition of a mesh: parts, each divided into k clusters, each cluster by an octree in its
// principal frame.
#pragma once

#include <span>

#include "build/paper/part_clusters.h"
#include "build/partition.h"

namespace octoblisk::detail {

/// The paper's partition over the triangles' centroids. `options.clusters` is 1..8. A leaf of more than 8
/// triangles becomes several leaves.
Partition paperPartition(std::span<const TriangleRecord> records, const PartClusterOptions& options);

}  // namespace octoblisk::detail
