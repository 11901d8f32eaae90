#include "octoblisk/query_cost.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octoblisk/query_cost.cpp"
#include <hwy/foreach_target.h>

#include "octoblisk/meeting_triangles.h"
#include "octoblisk/nearest_triangles.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::HWY_NAMESPACE {

QueryCost costOfMeeting(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, bool all) {
  QueryCost cost;
  forEachMeetingPair(
      a, b, b_in_a, NodePair(), [all](TrianglePair, NodePair) { return !all; }, cost);
  return cost;
}

QueryCost costOfNearest(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  QueryCost cost;
  Nearest nearest(a.mesh(), b.mesh(), b_in_a, {});
  searchNearest(a, b, b_in_a, nearest, cost);
  nearest.settled();
  cost.exact_tests = nearest.measured();
  return cost;
}

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

HWY_EXPORT(costOfMeeting);
HWY_EXPORT(costOfNearest);

std::size_t QueryCost::bytes(const ClusteredOctree& a, const ClusteredOctree& b) const {
  const auto bytesOfLeaf = [](const ClusteredOctree& tree) {
    return 9 * sizeof(float) * tree.stats().triangles / tree.stats().leaves;
  };
  const std::size_t boxes = a.isCompact() ? sizeof(CompactNode) : sizeof(Box8);
  return box_tests * boxes + leaf_pairs * (bytesOfLeaf(a) + bytesOfLeaf(b)) +
         exact_tests * 2 * sizeof(Triangle);
}

QueryCost costOfCollide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  return HWY_DYNAMIC_DISPATCH(costOfMeeting)(a, b, b_in_a, false);
}

QueryCost costOfTouchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  return HWY_DYNAMIC_DISPATCH(costOfMeeting)(a, b, b_in_a, true);
}

QueryCost costOfDistance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  return HWY_DYNAMIC_DISPATCH(costOfNearest)(a, b, b_in_a);
}

}  // namespace octoblisk
#endif
