// The one walk that all queries share: down two trees, or one tree and a box, over boxes that may overlap.
//
// Boxes are compared in single precision, grown by the rounding of the comparison, so that nothing is missed.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

/// Distances in single precision err by less than this part of the sizes involved: 64 units in the last place
/// of the summed radii and the distance of the origins.
inline constexpr double kTraversalRounding = 0x1p-18;

/// Beyond it lie only the empty boxes of a node: a reach is cut off here, so that they are never entered.
inline constexpr double kFarthest = 1e29;

/// The walk's to-do list. One entry is taken and at most eight are put for it, and each has a box less above
/// its leaves: this never overflows.
template <typename Entry, int kLevels>
class TraversalStack {
 public:
  bool empty() const { return count_ == 0; }
  const Entry& pop() { return entries_[--count_]; }

  /// Puts an entry so that those since `first` come out by ascending gap.
  void pushSorted(std::size_t first, const Entry& entry) {
    std::size_t place = count_++;
    for (; place > first && entries_[place - 1].gap < entry.gap; --place)
      entries_[place] = entries_[place - 1];
    entries_[place] = entry;
  }
  std::size_t size() const { return count_; }

 private:
  std::array<Entry, (kLanes - 1) * kLevels + 1> entries_;
  std::size_t count_ = 0;
};

/// Calls put(lane, gap) for each of the eight boxes that is no farther than `reach` from `box`.
template <typename Put>
void forEachWithin(const Box8& boxes, const BoxF& box, float reach, Put&& put) {
  const Float8 gap = widestGap(boxes, box);
  unsigned near = 0;
  for (int lane = 0; lane < kLanes; ++lane) near |= static_cast<unsigned>(gap[lane] <= reach) << lane;
  for (; near != 0; near &= near - 1) {
    const int lane = std::countr_zero(near);
    put(static_cast<std::uint32_t>(lane), gap[lane]);
  }
}

/// Calls visit(leaf_of_a, leaf_of_b) for all pairs of leaves whose boxes, and all boxes above, may be within
/// `reach` of each other, those that overlap most first. Returns true as soon as visit does, else false.
template <typename Visit>
bool traversePairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double reach,
                   Visit&& visit) {
  struct Entry {
    Slot a, b;
    float gap;
    Entry() = default;
    Entry(Slot slot_a, Slot slot_b, float widest_gap) : a(slot_a), b(slot_b), gap(widest_gap) {}
  };
  const Pose local{b_in_a.rotation, b_in_a * b.origin() - a.origin()};  // between the trees' local frames
  const PoseF b_to_a(local), a_to_b(local.inverse());
  const auto limit = static_cast<float>(std::min(
      kFarthest, reach + kTraversalRounding * (local.translation.norm() + a.radius() + b.radius() + reach)));

  const auto gap = [&] {
    return widestGap(a.boxes(ClusteredOctree::kRoot), b_to_a * b.boxes(ClusteredOctree::kRoot).get(0))[0];
  }();
  if (!(gap <= limit)) return false;
  TraversalStack<Entry, 2 * ClusteredOctree::kMaxDepth> stack;
  stack.pushSorted(0, {ClusteredOctree::kRoot, ClusteredOctree::kRoot, gap});
  while (!stack.empty()) {
    const Entry pair = stack.pop();
    const Child child_a = a.child(pair.a), child_b = b.child(pair.b);
    if (child_a.isLeaf() && child_b.isLeaf()) {
      if (visit(child_a, child_b)) return true;
      continue;
    }
    const std::size_t first = stack.size();
    const auto lane_a = static_cast<int>(pair.a.lane), lane_b = static_cast<int>(pair.b.lane);
    const bool a_is_larger =
        a.boxes(pair.a).largestHalfExtent(lane_a) >= b.boxes(pair.b).largestHalfExtent(lane_b);
    if (child_b.isLeaf() || (!child_a.isLeaf() && a_is_larger)) {
      const BoxF box = b_to_a * b.boxes(pair.b).get(lane_b);
      const std::uint32_t node = child_a.node();
      forEachWithin(a.nodes()[node].boxes, box, limit, [&](std::uint32_t lane, float widest_gap) {
        stack.pushSorted(first, {{node, lane}, pair.b, widest_gap});
      });
    } else {
      const BoxF box = a_to_b * a.boxes(pair.a).get(lane_a);
      const std::uint32_t node = child_b.node();
      forEachWithin(b.nodes()[node].boxes, box, limit, [&](std::uint32_t lane, float widest_gap) {
        stack.pushSorted(first, {pair.a, {node, lane}, widest_gap});
      });
    }
  }
  return false;
}

/// Calls visit(leaf) for all leaves whose boxes may be within `reach` of a box in the mesh's frame, those
/// that overlap most first. Returns true as soon as visit does, else false.
template <typename Visit>
bool traverseBox(const ClusteredOctree& tree, const Obb& box_in_tree, double reach, Visit&& visit) {
  struct Entry {
    Slot slot;
    float gap;
    Entry() = default;
    Entry(Slot at, float widest_gap) : slot(at), gap(widest_gap) {}
  };
  const Vec3 center = box_in_tree.center - tree.origin();
  const BoxF box{center.cast<float>(), box_in_tree.axes.cast<float>(),
                 box_in_tree.half_extents.cast<float>()};
  const auto limit = static_cast<float>(std::min(
      kFarthest, reach + kTraversalRounding *
                             (center.norm() + tree.radius() + box_in_tree.half_extents.norm() + reach)));

  const float gap = widestGap(tree.boxes(ClusteredOctree::kRoot), box)[0];
  if (!(gap <= limit)) return false;
  TraversalStack<Entry, ClusteredOctree::kMaxDepth> stack;
  stack.pushSorted(0, {ClusteredOctree::kRoot, gap});
  while (!stack.empty()) {
    const Child child = tree.child(stack.pop().slot);
    if (child.isLeaf()) {
      if (visit(child)) return true;
      continue;
    }
    const std::size_t first = stack.size();
    const std::uint32_t node = child.node();
    forEachWithin(tree.nodes()[node].boxes, box, limit, [&](std::uint32_t lane, float widest_gap) {
      stack.pushSorted(first, {{node, lane}, widest_gap});
    });
  }
  return false;
}

}  // namespace octoblisk
