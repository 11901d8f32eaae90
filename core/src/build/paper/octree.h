// The paper's octree over points: cells are halved in all three directions until they contain at most a fixed
// number of points (section 2.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/types.h"

namespace octoblisk::detail {

struct OctreeOptions {
  std::size_t leaf_capacity = 8;  ///< the paper's fixed number of points (FNOP), at least 1
  bool cubic = false;  ///< whether the root is a cube; otherwise it is the points' bounding box (erratum 9)
  Mat3 axes = Mat3::Identity();  ///< the frame of all cells
};

struct OctreeStats {
  std::size_t total_nodes = 0;  ///< TNON as the paper counts it: 1 + 8 · splits, including empty children
  std::size_t non_empty_leaves = 0;
  int depth = 0;             ///< of the deepest node; the root has depth 0
  double root_volume = 0.0;  ///< of the root cell
  double leaf_volume = 0.0;  ///< of the cells of all non-empty leaves
};

/// An immutable octree. A divided cell has all eight children, including empty ones. A point on the boundary
/// between two cells belongs to the upper one.
class Octree {
 public:
  struct Node {
    Vec3 center;  ///< of the cell, in the octree's frame
    Vec3 half_extents;
    std::uint32_t begin = 0;  ///< the points of the cell: order()[begin .. end)
    std::uint32_t end = 0;
    std::uint32_t first_child = 0;  ///< the eight children are consecutive; 0 for a leaf
    int depth = 0;

    bool isLeaf() const { return first_child == 0; }
    std::uint32_t count() const { return end - begin; }
  };

  static constexpr int kMaxDepth = 32;  ///< cells at this depth are not divided

  /// Throws std::invalid_argument if there are no points or at least 2^29 - 1, or if the leaf capacity is 0.
  static Octree build(std::span<const Vec3> points, const OctreeOptions& options = {});

  const std::vector<Node>& nodes() const { return nodes_; }           ///< the root first
  const std::vector<std::uint32_t>& order() const { return order_; }  ///< point indices, cell by cell
  const OctreeStats& stats() const { return stats_; }

  /// The cell of a node as a box in the points' frame.
  Obb cell(const Node& node) const { return {axes_ * node.center, axes_, node.half_extents}; }

 private:
  Octree() = default;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  OctreeStats stats_;
  Mat3 axes_ = Mat3::Identity();
};

}  // namespace octoblisk::detail
