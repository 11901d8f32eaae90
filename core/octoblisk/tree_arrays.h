// What a clustered octree is made of: nodes of up to eight boxes each, and the triangles in the order of the
// leaves. Arrays alone, so that they may lie in memory of their own or in a file.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/box8.h"

namespace octoblisk {

/// What a box of a node holds: another node, a leaf of 1..8 triangles, or nothing.
class Child {
 public:
  Child() = default;
  static Child node(std::uint32_t index) { return Child(index); }
  static Child leaf(std::uint32_t first, std::uint32_t count) {
    return Child(kLeafBit | first << 3 | (count - 1));
  }

  bool isLeaf() const { return (bits_ & kLeafBit) != 0; }
  bool isEmpty() const { return bits_ == 0; }
  std::uint32_t node() const { return bits_; }
  std::uint32_t first() const { return (bits_ & ~kLeafBit) >> 3; }  ///< of a leaf, in triangleOrder()
  std::uint32_t count() const { return (bits_ & 7u) + 1; }          ///< of a leaf

 private:
  explicit Child(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  std::uint32_t bits_ = 0;
};

/// One box of one node.
struct Slot {
  std::uint32_t node, lane;
};

struct alignas(64) TreeNode {
  Box8 boxes;
  std::array<Child, kLanes> children;
};
static_assert(sizeof(TreeNode) == 512);  // eight cache lines

/// A tree's arrays. Nodes are in depth-first order, the first of them holds the box of the whole tree alone,
/// in lane 0, and the triangles below a node are a range of the order.
struct TreeArrays {
  std::span<const TreeNode> nodes;
  std::span<const std::uint32_t> triangle_order;
  std::span<const float> leaf_vertices;  ///< see ClusteredOctree::leafVertices

  Child child(Slot slot) const { return nodes[slot.node].children[slot.lane]; }
  std::size_t nodeCount() const { return nodes.size(); }
  BoxF box(Slot slot) const { return nodes[slot.node].boxes.get(static_cast<int>(slot.lane)); }
  std::size_t bytes() const {
    return nodes.size_bytes() + triangle_order.size_bytes() + leaf_vertices.size_bytes();
  }
};

/// The arrays in memory of their own.
struct OwnedArrays {
  std::vector<TreeNode> nodes;
  std::vector<std::uint32_t> triangle_order;
  std::vector<float> leaf_vertices;

  TreeArrays view() const { return {nodes, triangle_order, leaf_vertices}; }
};

/// Calls visit(slot, child) for all boxes of the tree in the order of their nodes.
template <typename Visit>
void forEachChild(const TreeArrays& tree, Visit&& visit) {
  for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Child child = tree.child({n, lane});
      if (!child.isEmpty()) visit(Slot{n, lane}, child);
    }
  }
}

}  // namespace octoblisk
