#include "query_cost.h"

#include <algorithm>
#include <optional>

// This file counts and is not timed, so the instruction set of the whole build is enough.
#include "geometry/ray_triangle.h"
#include "query/collide_walk-inl.h"
#include "query/distance_walk-inl.h"
#include "query/ray_walk-inl.h"
#include "tree/tree.h"

namespace octoblisk::bench {

using namespace detail;
using namespace detail::HWY_NAMESPACE;

namespace {

QueryCost costOfMeeting(const Tree& a, const Tree& b, const Pose& b_in_a, bool all) {
  QueryCost cost;
  forEachMeetingPair(
      a, b, b_in_a, NodePair(), [all](TrianglePair, NodePair) { return !all; }, cost);
  return cost;
}

QueryCost costOfNearest(const Tree& a, const Tree& b, const Pose& b_in_a) {
  QueryCost cost;
  DistanceSearch search(a.mesh(), b.mesh(), b_in_a, {});
  searchNearest(a, b, b_in_a, search, cost);
  search.settled();
  cost.exact_tests = search.measured();
  return cost;
}

QueryCost costOfRay(const Tree& tree, const Ray& ray, const LocalRay& local) {
  QueryCost cost;
  double closest = ray.t_max;
  const auto shorten = [&](std::uint32_t triangle) {
    const auto found = crossing(ray.origin, ray.direction, tree.mesh().triangle(triangle));
    if (found) closest = std::min(closest, found->t);
    return closest;
  };
  RayDescent(tree, local, shorten, cost).run();
  return cost;
}

std::size_t bytesOfBoxes(const ClusteredOctree& tree) {
  return treeOf(tree).isCompact() ? sizeof(CompactNode) : sizeof(Box8);
}

/// The average size of a leaf's corners, in bytes.
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
  return costOfMeeting(treeOf(a), treeOf(b), b_in_a, false);
}

QueryCost costOfTouchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  return costOfMeeting(treeOf(a), treeOf(b), b_in_a, true);
}

QueryCost costOfDistance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  return costOfNearest(treeOf(a), treeOf(b), b_in_a);
}

QueryCost costOfClosestHit(const ClusteredOctree& tree, const Ray& ray) {
  const std::optional<LocalRay> local = clipped(treeOf(tree), ray);
  return local ? costOfRay(treeOf(tree), ray, *local) : QueryCost();
}

}  // namespace octoblisk::bench
