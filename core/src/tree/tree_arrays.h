// The data of a clustered octree: nodes of up to eight boxes each, full or compact, and the triangles in the
// order of the leaves. All data are arrays, so that they may be in memory or in a file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "simd/box8.h"
#include "tree/child.h"
#include "tree/compact_node.h"

namespace octoblisk::detail {

struct alignas(64) TreeNode {
  Box8 boxes;
  std::array<Child, kLanes> children;
};
static_assert(sizeof(TreeNode) == 512);  // eight cache lines

/// The size of a full tree's TreeArrays::leaf_vertices.
constexpr std::size_t leafVerticesSize(std::size_t triangles) { return 9 * triangles + kLanes; }

/// The arrays of a tree: `nodes` and `leaf_vertices` for a full tree, `compact_nodes` for a compact one.
/// Nodes are in depth-first order. The first node contains only the box of the whole tree, in lane 0. The
/// triangles below a node are a range of triangle_order.
struct TreeArrays {
  std::span<const TreeNode> nodes;
  std::span<const CompactNode> compact_nodes;
  std::span<const std::uint32_t> triangle_order;
  std::span<const float> leaf_vertices;  ///< nine rows per leaf (leaf_vertices.h), and eight to spare

  bool isCompact() const { return !compact_nodes.empty(); }
  std::size_t nodeCount() const { return isCompact() ? compact_nodes.size() : nodes.size(); }
  const std::array<Child, kLanes>& children(std::uint32_t node) const {
    return isCompact() ? compact_nodes[node].children : nodes[node].children;
  }
  Child child(Slot slot) const { return children(slot.node)[slot.lane]; }
  BoxF box(Slot slot) const {
    return isCompact() ? compact_nodes[slot.node].box(slot.lane) : nodes[slot.node].boxes.get(slot.lane);
  }
  std::span<const std::uint32_t> triangles(Child leaf) const {
    return triangle_order.subspan(leaf.first(), leaf.count());
  }
  std::size_t bytes() const {
    return nodes.size_bytes() + compact_nodes.size_bytes() + triangle_order.size_bytes() +
           leaf_vertices.size_bytes();
  }
};

/// Arrays in their own memory.
struct OwnedArrays {
  std::vector<TreeNode> nodes;
  std::vector<CompactNode> compact_nodes;
  std::vector<std::uint32_t> triangle_order;
  std::vector<float> leaf_vertices;

  OwnedArrays() = default;
  explicit OwnedArrays(const TreeArrays& tree)
      : nodes(tree.nodes.begin(), tree.nodes.end()),
        compact_nodes(tree.compact_nodes.begin(), tree.compact_nodes.end()),
        triangle_order(tree.triangle_order.begin(), tree.triangle_order.end()),
        leaf_vertices(tree.leaf_vertices.begin(), tree.leaf_vertices.end()) {}

  TreeArrays view() const { return {nodes, compact_nodes, triangle_order, leaf_vertices}; }
};

/// Calls visit(slot, child) for all boxes of the tree in the order of their nodes.
template <typename Visit>
void forEachChild(const TreeArrays& tree, Visit&& visit) {
  for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Child child = tree.children(n)[lane];
      if (!child.isEmpty()) visit(Slot{n, lane}, child);
    }
  }
}

}  // namespace octoblisk::detail
