// The one walk that all queries share: down two trees, or one tree and a box, over boxes that may overlap.
// Read once for each target (simd.h).
//
// Boxes are compared in single precision, grown by the rounding of the comparison, so that nothing is missed.
#if defined(OCTOBLISK_TRAVERSAL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_TRAVERSAL_H
#undef OCTOBLISK_TRAVERSAL_H
#else
#define OCTOBLISK_TRAVERSAL_H
#endif

#include <algorithm>
#include <bit>

#include "octoblisk/detail/node_pair.h"
#include "query/local_pose.h"
#include "query/traversal_queue.h"
#include "query/traversal_stack.h"
#include "simd/box_gap-inl.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls put(lane, gap) for each of the eight gaps that is no larger than `limit`.
template <typename Put>
HWY_INLINE void forEachWithin(const Float8& gap, float limit, Put&& put) {
  unsigned near = kAllLanes & ~less(Float8(limit), gap);
  if (near == 0) return;
  float gaps[kLanes];
  gap.store(gaps);
  for (; near != 0; near &= near - 1) {
    const int lane = std::countr_zero(near);
    put(static_cast<std::uint32_t>(lane), gaps[lane]);
  }
}

/// Calls visit(slot_of_a, slot_of_b) for all pairs of leaves below the two nodes of which no gap(boxes, box),
/// nor one of the boxes between, is larger than limit(), which may shrink; the smallest gaps first: of all,
/// to begin with, with a TraversalQueue, of those below the same pair with a TraversalStack. Returns true as
/// soon as visit does, else false. Where the pose is not finite, nothing is near.
template <template <typename Entry, int kLevels> typename ToDo, typename Gap, typename Limit, typename Visit>
bool walkPairs(const Tree& a, const Tree& b, const LocalPose& pose, NodePair below, Gap&& gap, Limit&& limit,
               Visit&& visit) {
  struct Entry {
    Slot a, b;
    float gap;
  };
  if (!(pose.size <= kFarthest)) return false;
  ToDo<Entry, 2 * Tree::kMaxDepth> to_do;
  Box8 room(Box8::Unset{}), room_of_one(Box8::Unset{});
  for (std::uint32_t lane_b = 0; lane_b < kLanes; ++lane_b) {
    const Slot slot_b{below.b, lane_b};
    if (b.child(slot_b).isEmpty()) continue;
    const BoxF box = posed(pose.b_to_a, boxesAt(b, slot_b, room_of_one), lane_b);
    forEachWithin(gap(boxesOf(a, below.a, room), box), limit(), [&](std::uint32_t lane_a, float found) {
      to_do.pushSorted(0, {{below.a, lane_a}, slot_b, found});
    });
  }
  while (!to_do.empty()) {
    const Entry pair = to_do.pop();
    if (pair.gap > limit()) {
      to_do.dismiss();
      continue;
    }
    const Child child_a = a.child(pair.a), child_b = b.child(pair.b);
    if (child_a.isEmpty() || child_b.isEmpty()) continue;  // of a pose that is none, as all gaps are NaN
    if (child_a.isLeaf() && child_b.isLeaf()) {
      if (visit(pair.a, pair.b)) return true;
      to_do.sawLeaves(limit());
      continue;
    }
    const std::size_t first = to_do.size();
    const bool a_is_larger = largestHalfExtent(a, pair.a) >= largestHalfExtent(b, pair.b);
    if (child_b.isLeaf() || (!child_a.isLeaf() && a_is_larger)) {
      const BoxF box = posed(pose.b_to_a, boxesAt(b, pair.b, room), pair.b.lane);
      const std::uint32_t node = child_a.node();
      forEachWithin(gap(boxesOf(a, node, room), box), limit(), [&](std::uint32_t lane, float found) {
        to_do.pushSorted(first, {{node, lane}, pair.b, found});
      });
    } else {
      const BoxF box = posed(pose.a_to_b, boxesAt(a, pair.a, room), pair.a.lane);
      const std::uint32_t node = child_b.node();
      forEachWithin(gap(boxesOf(b, node, room), box), limit(), [&](std::uint32_t lane, float found) {
        to_do.pushSorted(first, {pair.a, {node, lane}, found});
      });
    }
  }
  return false;
}

/// The same for the leaves of one tree and a box in its local frame: visit(slot_of_leaf).
template <typename Gap, typename Limit, typename Visit>
bool walkBox(const Tree& tree, const LocalBox& local, Gap&& gap, Limit&& limit, Visit&& visit) {
  struct Entry {
    Slot slot;
    float gap;
  };
  if (!(local.size <= kFarthest)) return false;
  const BoxF& box = local.box;
  TraversalStack<Entry, Tree::kMaxDepth> stack;
  Box8 room(Box8::Unset{});
  forEachWithin(gap(boxesOf(tree, 0, room), box), limit(), [&](std::uint32_t lane, float found) {
    stack.pushSorted(0, {{0, lane}, found});
  });
  while (!stack.empty()) {
    const Entry entry = stack.pop();
    if (entry.gap > limit()) continue;
    const Child child = tree.child(entry.slot);
    if (child.isEmpty()) continue;  // of a box that is none, as all gaps are NaN
    if (child.isLeaf()) {
      if (visit(entry.slot)) return true;
      continue;
    }
    const std::size_t first = stack.size();
    const std::uint32_t node = child.node();
    forEachWithin(gap(boxesOf(tree, node, room), box), limit(), [&](std::uint32_t lane, float found) {
      stack.pushSorted(first, {{node, lane}, found});
    });
  }
  return false;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
