// The traversal that most queries share (not rays, SourceContacts, NearFeatures and farthestVertex): down two
// trees, or down one tree with a box, through boxes that may be near. Included once for each target
// (simd-inl.h).
//
// Boxes are compared in single precision and grown by the rounding error, so that nothing is missed.
#if defined(OCTOBLISK_QUERY_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_TRAVERSAL_INL_H
#undef OCTOBLISK_QUERY_TRAVERSAL_INL_H
#else
#define OCTOBLISK_QUERY_TRAVERSAL_INL_H
#endif

#include "query/local_pose.h"
#include "query/node_pair.h"
#include "query/traversal_queue.h"
#include "query/traversal_stack.h"
#include "simd/box_gap-inl.h"
#include "simd/lanes.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls put(lane, gap) for each of the eight gaps that is at most `limit`.
template <typename Put>
HWY_INLINE void forEachWithin(const Float8& gap, float limit, Put&& put) {
  const unsigned near = kAllLanes & ~less(Float8(limit), gap);
  if (near == 0) return;
  float gaps[kLanes];
  gap.store(gaps);
  for (const std::uint32_t lane : Lanes(near)) put(lane, gaps[lane]);
}

/// Ends a traversal at the leaves.
struct AtLeaves {
  using Place = Slot;
  static Place first(Slot slot) { return slot; }
  static Slot slot(Place place) { return place; }
  static Place below(Place, Slot slot) { return slot; }
  static bool isEnd(Place, Child child) { return child.isLeaf(); }
};

/// Ends a traversal at the boxes of a depth (the root's box has depth 0) and at leaves above it.
struct AtDepth {
  struct Place {
    Slot at;
    int depth;
  };
  static Place first(Slot slot) { return {slot, 0}; }
  static Slot slot(Place place) { return place.at; }
  static Place below(Place place, Slot slot) { return {slot, place.depth + 1}; }
  bool isEnd(Place place, Child child) const { return place.depth >= depth || child.isLeaf(); }

  int depth;
};

/// Calls visit(slot_of_a, slot_of_b) for pairs of ends below the two nodes. The ends are the leaves, or the
/// boxes at a depth (`end`). Skips a pair if gap(boxes, box) of it, or of a pair above it, exceeds limit(),
/// which may shrink. The smallest gap comes first: with a TraversalQueue, at first among all pairs; with a
/// TraversalStack, among the pairs below one pair. Returns true as soon as a visit does, otherwise false.
/// Visits nothing if the pose is not finite.
template <template <typename Entry, int kLevels> typename ToDo, typename End = AtLeaves, typename Gap,
          typename Limit, typename Visit>
bool walkPairs(const Tree& a, const Tree& b, const LocalPose& pose, NodePair below, Gap&& gap, Limit&& limit,
               Visit&& visit, const End& end = {}) {
  using Place = typename End::Place;
  struct Entry {
    Place a, b;
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
      to_do.pushSorted(0, {End::first({below.a, lane_a}), End::first(slot_b), found});
    });
  }
  while (!to_do.empty()) {
    const Entry pair = to_do.pop();
    if (pair.gap > limit()) {
      to_do.dismiss();
      continue;
    }
    const Slot slot_a = End::slot(pair.a), slot_b = End::slot(pair.b);
    const Child child_a = a.child(slot_a), child_b = b.child(slot_b);
    if (child_a.isEmpty() || child_b.isEmpty()) continue;  // the pose is not finite: all gaps are NaN
    const bool a_ends = end.isEnd(pair.a, child_a), b_ends = end.isEnd(pair.b, child_b);
    if (a_ends && b_ends) {
      if (visit(slot_a, slot_b)) return true;
      to_do.sawLeaves(limit());
      continue;
    }
    const std::size_t first = to_do.size();
    const bool a_is_larger = largestHalfExtent(a, slot_a) >= largestHalfExtent(b, slot_b);
    if (b_ends || (!a_ends && a_is_larger)) {
      const BoxF box = posed(pose.b_to_a, boxesAt(b, slot_b, room), slot_b.lane);
      const std::uint32_t node = child_a.node();
      forEachWithin(gap(boxesOf(a, node, room), box), limit(), [&](std::uint32_t lane, float found) {
        to_do.pushSorted(first, {End::below(pair.a, {node, lane}), pair.b, found});
      });
    } else {
      const BoxF box = posed(pose.a_to_b, boxesAt(a, slot_a, room), slot_a.lane);
      const std::uint32_t node = child_b.node();
      forEachWithin(gap(boxesOf(b, node, room), box), limit(), [&](std::uint32_t lane, float found) {
        to_do.pushSorted(first, {pair.a, End::below(pair.b, {node, lane}), found});
      });
    }
  }
  return false;
}

/// The same for the ends of one tree and a box in its local frame: visit(slot).
template <typename End = AtLeaves, typename Gap, typename Limit, typename Visit>
bool walkBox(const Tree& tree, const LocalBox& local, Gap&& gap, Limit&& limit, Visit&& visit,
             const End& end = {}) {
  using Place = typename End::Place;
  struct Entry {
    Place place;
    float gap;
  };
  if (!(local.size <= kFarthest)) return false;
  const BoxF& box = local.box;
  TraversalStack<Entry, Tree::kMaxDepth> stack;
  Box8 room(Box8::Unset{});
  forEachWithin(gap(boxesOf(tree, 0, room), box), limit(), [&](std::uint32_t lane, float found) {
    stack.pushSorted(0, {End::first({0, lane}), found});
  });
  while (!stack.empty()) {
    const Entry entry = stack.pop();
    if (entry.gap > limit()) continue;
    const Slot slot = End::slot(entry.place);
    const Child child = tree.child(slot);
    if (child.isEmpty()) continue;  // the box is not finite: all gaps are NaN
    if (end.isEnd(entry.place, child)) {
      if (visit(slot)) return true;
      continue;
    }
    const std::size_t first = stack.size();
    const std::uint32_t node = child.node();
    forEachWithin(gap(boxesOf(tree, node, room), box), limit(), [&](std::uint32_t lane, float found) {
      stack.pushSorted(first, {End::below(entry.place, {node, lane}), found});
    });
  }
  return false;
}

/// Calls visit(leaf) for all leaves whose boxes have a gap of at most `limit`, in no particular order.
/// Returns true as soon as a visit does, otherwise false. Nothing is near if the box is not finite.
template <typename Gap, typename Visit>
bool forEachLeafWithin(const Tree& tree, const LocalBox& local, Gap&& gap, float limit, Visit&& visit) {
  if (!(local.size <= kFarthest)) return false;
  const BoxF& box = local.box;
  TraversalStack<std::uint32_t, Tree::kMaxDepth> nodes;
  nodes.push(0);
  Box8 room(Box8::Unset{});
  while (!nodes.empty()) {
    const std::uint32_t node = nodes.pop();
    const unsigned near = kAllLanes & ~less(Float8(limit), gap(boxesOf(tree, node, room), box));
    for (const std::uint32_t lane : Lanes(near)) {
      const Slot slot{node, lane};
      const Child child = tree.child(slot);
      if (child.isEmpty()) continue;  // the box is not finite: all gaps are NaN
      if (!child.isLeaf()) {
        nodes.push(child.node());
      } else if (visit(slot)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
