#include "octoblisk/tree_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/refit.h"

namespace octoblisk {
namespace {

[[noreturn]] void reject(const std::string& what) { throw std::invalid_argument(what); }

std::string nameOf(Slot slot) {
  return "box " + std::to_string(slot.lane) + " of node " + std::to_string(slot.node);
}

void checkSizes(const TreeArrays& tree, std::size_t triangles) {
  if (tree.nodes.empty() == tree.compact_nodes.empty()) reject("there must be nodes of one kind");
  if (tree.triangle_order.size() != triangles) {
    reject("the leaves hold " + std::to_string(tree.triangle_order.size()) + " triangles, the mesh " +
           std::to_string(triangles));
  }
  if (tree.leaf_vertices.size() != (tree.isCompact() ? 0 : 9 * triangles + kLanes)) {
    reject("there are " + std::to_string(tree.leaf_vertices.size()) + " coordinates in leaves of " +
           std::to_string(triangles) + " triangles");
  }
}

/// Walks down all nodes, which come in the order of the walk, and so each once.
class Walk {
 public:
  explicit Walk(const TreeArrays& tree) : tree_(tree), is_held_(tree.triangle_order.size(), false) {
    for (std::uint32_t lane = 1; lane < kLanes; ++lane) {
      if (!tree.children(0)[lane].isEmpty()) reject("the first node has more than one box");
    }
    node(0, 1);
    if (next_node_ != tree.nodeCount()) reject("node " + std::to_string(next_node_) + " is below no other");
    const auto missing = std::ranges::find(is_held_, false);
    if (missing != is_held_.end())
      reject("place " + std::to_string(missing - is_held_.begin()) + " of the order is in no leaf");
  }

 private:
  struct Below {
    std::size_t begin = std::numeric_limits<std::size_t>::max(), end = 0, count = 0;  ///< of the order

    void extend(const Below& other) {
      begin = std::min(begin, other.begin);
      end = std::max(end, other.end);
      count += other.count;
    }
  };

  Below node(std::uint32_t index, int depth) {
    if (depth > ClusteredOctree::kMaxDepth)
      reject("the tree is deeper than " + std::to_string(ClusteredOctree::kMaxDepth));
    Below below;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot slot{index, lane};
      const Child child = tree_.child(slot);
      if (child.isEmpty()) continue;
      if (child.isLeaf()) {
        below.extend(leaf(slot, child));
      } else if (child.node() == next_node_ && child.node() < tree_.nodeCount()) {
        ++next_node_;
        below.extend(node(child.node(), depth + 1));
      } else {
        reject("the child of " + nameOf(slot) + " is not the next node");
      }
    }
    if (below.count == 0) reject("node " + std::to_string(index) + " is empty");
    if (below.end - below.begin != below.count)
      reject("what is below node " + std::to_string(index) + " is not a range of the order");
    return below;
  }

  Below leaf(Slot slot, Child leaf) {
    const Below range{leaf.first(), std::size_t{leaf.first()} + leaf.count(), leaf.count()};
    if (range.end > is_held_.size()) reject("the leaf in " + nameOf(slot) + " ends beyond the order");
    for (std::size_t place = range.begin; place < range.end; ++place) {
      if (is_held_[place])
        reject("place " + std::to_string(place) + " of the order is in more than one leaf");
      is_held_[place] = true;
    }
    return range;
  }

  const TreeArrays& tree_;
  std::vector<bool> is_held_;
  std::size_t next_node_ = 1;
};

void checkOrder(std::span<const std::uint32_t> order) {
  std::vector<bool> is_there(order.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= order.size() || is_there[order[i]]) {
      reject("place " + std::to_string(i) + " of the order has triangle " + std::to_string(order[i]) +
             ", which is not there or in another place as well");
    }
    is_there[order[i]] = true;
  }
}

/// Finite, its frame orthonormal, its half extents in descending order and neither they nor the centre
/// larger than in a tree of that radius.
bool isSound(const BoxF& box, float largest) {
  const Mat3 axes = box.axes.cast<double>();
  const Mat3 off = axes.transpose() * axes - Mat3::Identity();
  const Eigen::Vector3f& half = box.half_extents;
  return box.center.cwiseAbs().maxCoeff() <= largest && box.center.allFinite() && half.allFinite() &&
         half[0] <= largest && half[0] >= half[1] && half[1] >= half[2] && half[2] >= 0.0f &&
         off.allFinite() && off.cwiseAbs().maxCoeff() <= kOrthonormal;
}

/// Nothing overlaps it.
bool isEmptyBox(const BoxF& box, float largest) {
  return box.axes.isIdentity(0.0f) && (box.half_extents.array() == Box8::kEmptyHalfExtent).all() &&
         box.center.allFinite() && box.center.cwiseAbs().maxCoeff() <= largest;
}

void checkLeafVertices(std::span<const float> coordinates, float largest) {
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (!(std::abs(coordinates[i]) <= largest))
      reject("coordinate " + std::to_string(i) + " in the leaves is not one of this mesh");
  }
}

}  // namespace

void checkTree(const TreeArrays& tree, const TriangleMesh& mesh) {
  checkSizes(tree, mesh.triangleCount());
  checkOrder(tree.triangle_order);
  const Walk walk(tree);
  const double radius = mesh.bounds().halfExtents().norm();
  const auto largest = static_cast<float>(4.0 * (radius + double(boxPadding(radius))));
  checkLeafVertices(tree.leaf_vertices, largest);
  for (std::uint32_t n = 0; n < tree.nodeCount(); ++n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Slot slot{n, lane};
      if (tree.child(slot).isEmpty() ? !isEmptyBox(tree.box(slot), largest)
                                     : !isSound(tree.box(slot), largest))
        reject(nameOf(slot) + " is not one that a tree of this mesh has");
    }
  }
}

}  // namespace octoblisk
