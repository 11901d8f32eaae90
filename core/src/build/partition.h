// How the triangles of a mesh become the nested ranges that a tree is made of: by recursive clustering in
// position–normal space. The paper's own way is in build/paper.
#pragma once

#include <cstdint>
#include <vector>

#include "build/triangle_record.h"
#include "octoblisk/build_options.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// A range of triangles with the box that holds them and up to eight parts of it, or none for a leaf.
struct PartitionNode {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t first_child = 0;  ///< the children follow each other
  std::uint32_t child_count = 0;  ///< 0 for a leaf, else 2..8
  BoxF box;

  std::uint32_t count() const { return end - begin; }
};

struct Partition {
  std::vector<std::uint32_t> order;  ///< of the mesh's triangles: what the ranges refer to
  std::vector<PartitionNode> nodes;  ///< the root first, parents before children
};

struct ClusteringOptions {
  int leaf_capacity = 8;  ///< 1..8
  BuildQuality quality = BuildQuality::high;
  int threads = 1;  ///< at least 1; the partition does not depend on it
};

/// Divides each node into up to eight clusters of triangles alike in place and facing, where the boxes round
/// them are smallest, down to the leaf capacity.
Partition clusteringPartition(TriangleRecords records, const ClusteringOptions& options);

}  // namespace octoblisk::detail
