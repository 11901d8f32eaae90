#include "octoblisk/query_cost.h"

#include <algorithm>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "octoblisk/query_cost.cpp"
#include <hwy/foreach_target.h>

#include "octoblisk/meeting_triangles.h"
#include "octoblisk/nearest_triangles.h"
#include "octoblisk/ray_descent.h"

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

QueryCost costOfWay(const ClusteredOctree& tree, const Ray& ray, const LocalRay& local) {
  QueryCost cost;
  double closest = ray.t_max;
  const auto shorten = [&closest](const RayCrossing& crossing) {
    return closest = std::min(closest, crossing.t);
  };
  RayDescent(tree, ray, local, shorten, cost).run();
  return cost;
}

}  // namespace octoblisk::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

HWY_EXPORT(costOfMeeting);
HWY_EXPORT(costOfNearest);
HWY_EXPORT(costOfWay);

namespace {

std::size_t bytesOfBoxes(const ClusteredOctree& tree) {
  return tree.isCompact() ? sizeof(CompactNode) : sizeof(Box8);
}

/// Of the corners, on average.
std::size_t bytesOfLeaf(const ClusteredOctree& tree) {
  return 9 * sizeof(float) * tree.stats().triangles / tree.stats().leaves;
}

}  // namespace

std::size_t QueryCost::bytes(const ClusteredOctree& a, const ClusteredOctree& b) const {
  return box_tests * bytesOfBoxes(a) + leaf_pairs * (bytesOfLeaf(a) + bytesOfLeaf(b)) +
         exact_tests * 2 * sizeof(Triangle);
}

std::size_t QueryCost::bytes(const ClusteredOctree& tree) const {
  return box_tests * bytesOfBoxes(tree) + leaf_pairs * bytesOfLeaf(tree) + exact_tests * sizeof(Triangle);
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

QueryCost costOfClosestHit(const ClusteredOctree& tree, const Ray& ray) {
  const std::optional<LocalRay> local = clipped(tree, ray);
  return local ? HWY_DYNAMIC_DISPATCH(costOfWay)(tree, ray, *local) : QueryCost();
}

}  // namespace octoblisk
#endif
