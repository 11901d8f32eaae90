#include "contact/clusters_near.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/clusters_near.cpp"
#include <hwy/foreach_target.h>

#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// A box of a tree, and how far below the root's.
struct Cluster {
  Slot slot;
  int depth;

  Cluster below(std::uint32_t node, std::uint32_t lane) const { return {{node, lane}, depth + 1}; }
};

/// Whether the search looks below the cluster's box.
HWY_INLINE bool opens(const Tree& tree, const Cluster& cluster, int depth) {
  return cluster.depth < depth && !tree.child(cluster.slot).isLeaf();
}

bool clustersNearBox(const Tree& tree, const Obb& box_in_tree, double reach, int depth) {
  struct Entry {
    Cluster cluster;
    float gap;
  };
  const LocalBox local(tree, box_in_tree);
  if (!(local.size <= kFarthest)) return false;
  const float limit = traversalLimit(reach, local.size);
  TraversalStack<Entry, Tree::kMaxDepth> to_do;
  Box8 room(Box8::Unset{});
  forEachWithin(widestGap(boxesOf(tree, 0, room), local.box), limit, [&](std::uint32_t lane, float gap) {
    to_do.pushSorted(0, {{{0, lane}, 0}, gap});
  });
  while (!to_do.empty()) {
    const Cluster cluster = to_do.pop().cluster;
    const Child child = tree.child(cluster.slot);
    if (child.isEmpty()) continue;  // of a box that is none, as all gaps are NaN
    if (!opens(tree, cluster, depth)) return true;
    const std::size_t first = to_do.size();
    forEachWithin(widestGap(boxesOf(tree, child.node(), room), local.box), limit,
                  [&](std::uint32_t lane, float gap) {
                    to_do.pushSorted(first, {cluster.below(child.node(), lane), gap});
                  });
  }
  return false;
}

bool clustersNearClusters(const Tree& a, const Tree& b, const Pose& b_in_a, double reach, int depth) {
  struct Entry {
    Cluster a, b;
    float gap;
  };
  const LocalPose pose(a, b, b_in_a);
  if (!(pose.size <= kFarthest)) return false;
  const float limit = pose.limit(reach);
  TraversalStack<Entry, 2 * Tree::kMaxDepth> to_do;
  Box8 room(Box8::Unset{}), room_of_one(Box8::Unset{});
  const BoxF root_of_b = posed(pose.b_to_a, boxesAt(b, Tree::kRoot, room_of_one), 0);
  forEachWithin(widestGap(boxesOf(a, 0, room), root_of_b), limit, [&](std::uint32_t lane, float gap) {
    to_do.pushSorted(0, {{{0, lane}, 0}, {Tree::kRoot, 0}, gap});
  });
  while (!to_do.empty()) {
    const Entry pair = to_do.pop();
    const Child child_a = a.child(pair.a.slot), child_b = b.child(pair.b.slot);
    if (child_a.isEmpty() || child_b.isEmpty()) continue;  // of a pose that is none, as all gaps are NaN
    const bool opens_a = opens(a, pair.a, depth), opens_b = opens(b, pair.b, depth);
    if (!opens_a && !opens_b) return true;
    const std::size_t first = to_do.size();
    const bool a_is_larger = largestHalfExtent(a, pair.a.slot) >= largestHalfExtent(b, pair.b.slot);
    if (!opens_b || (opens_a && a_is_larger)) {
      const BoxF box = posed(pose.b_to_a, boxesAt(b, pair.b.slot, room), pair.b.slot.lane);
      forEachWithin(widestGap(boxesOf(a, child_a.node(), room), box), limit,
                    [&](std::uint32_t lane, float gap) {
                      to_do.pushSorted(first, {pair.a.below(child_a.node(), lane), pair.b, gap});
                    });
    } else {
      const BoxF box = posed(pose.a_to_b, boxesAt(a, pair.a.slot, room), pair.a.slot.lane);
      forEachWithin(widestGap(boxesOf(b, child_b.node(), room), box), limit,
                    [&](std::uint32_t lane, float gap) {
                      to_do.pushSorted(first, {pair.a, pair.b.below(child_b.node(), lane), gap});
                    });
    }
  }
  return false;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

HWY_EXPORT(clustersNearBox);
HWY_EXPORT(clustersNearClusters);

bool clustersNear(const ClusteredOctree& tree, const Obb& box_in_tree, double reach, int depth) {
  return HWY_DYNAMIC_DISPATCH(clustersNearBox)(treeOf(tree), box_in_tree, reach, depth);
}

bool clustersNear(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double reach,
                  int depth) {
  return HWY_DYNAMIC_DISPATCH(clustersNearClusters)(treeOf(a), treeOf(b), b_in_a, reach, depth);
}

}  // namespace octoblisk::detail
#endif
