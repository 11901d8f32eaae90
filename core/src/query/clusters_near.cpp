#include "query/clusters_near.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/clusters_near.cpp"
#include <hwy/foreach_target.h>

#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

bool clustersNearBox(const Tree& tree, const Obb& box_in_tree, double reach, int depth) {
  const LocalBox local(tree, box_in_tree);
  const auto limit = [reach = local.limit(reach)] { return reach; };
  return walkBox(
      tree, local, WidestGap(), limit, [](Slot) { return true; }, AtDepth{depth});
}

bool clustersNearClusters(const Tree& a, const Tree& b, const Pose& b_in_a, double reach, int depth) {
  const LocalPose pose(a, b, b_in_a);
  const auto limit = [reach = pose.limit(reach)] { return reach; };
  return walkPairs<TraversalStack>(
      a, b, pose, NodePair(), WidestGap(), limit, [](Slot, Slot) { return true; }, AtDepth{depth});
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
