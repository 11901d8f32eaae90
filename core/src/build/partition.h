// Divides the triangles of a mesh into the nested ranges of a tree, by recursive clustering in
// position–normal space. The paper's method is in build/paper.
#pragma once

#include <cstdint>
#include <vector>

#include "build/triangle_record.h"
#include "octoblisk/build_options.h"
#include "simd/box8.h"

namespace octoblisk::detail {

/// A range of triangles with their bounding box and up to eight subranges; a leaf has none.
struct PartitionNode {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t first_child = 0;  ///< the children are consecutive
  std::uint32_t child_count = 0;  ///< 0 for a leaf, otherwise 2..8
  BoxF box;

  std::uint32_t count() const { return end - begin; }
};

struct Partition {
  std::vector<std::uint32_t> order;  ///< of the mesh's triangles; the ranges refer to it
  std::vector<PartitionNode> nodes;  ///< the root first, parents before children
};

/// Divides each node into up to eight clusters of triangles with similar position and orientation, so that
/// their boxes are smallest, down to the leaf capacity. The partition does not depend on the number of
/// threads.
Partition clusteringPartition(TriangleRecords records, const BuildOptions& options);

}  // namespace octoblisk::detail
