// Finds the nearest triangles of two trees, leaf by leaf. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_DISTANCE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_DISTANCE_WALK_INL_H
#undef OCTOBLISK_QUERY_DISTANCE_WALK_INL_H
#else
#define OCTOBLISK_QUERY_DISTANCE_WALK_INL_H
#endif

#include "query/distance_search.h"
#include "query/pair_distances-inl.h"
#include "query/tally.h"
#include "query/traversal-inl.h"
#include "query/triangle_filter-inl.h"
#include "simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Offers the pairs of triangles that may be nearest, until none is left or nothing can be nearer.
template <typename Tally = NoTally>
void searchNearest(const Tree& a, const Tree& b, const Pose& b_in_a, DistanceSearch& search,
                   Tally&& tally = {}) {
  const LocalPose pose(a, b, b_in_a);
  const auto bound = [&](const Box8& boxes, const BoxF& box) HWY_ATTR {
    tally.boxTest();
    return squaredDistanceBound(boxes, box);
  };
  const auto limit = [&] { return squaredLimit(search.bound() + pose.doubles, pose.size); };
  PairDistances pairs;
  const auto measure = [&]() HWY_ATTR {
    tally.triangleTest();
    const bool done = search.consider(pairs.pairs(), pairs.bounds());
    pairs.clear();
    return done;
  };
  const auto visit = [&](Slot slot_a, Slot slot_b) HWY_ATTR {
    tally.leafPair();
    const LeafPair leaves(a, b, pose, slot_a, slot_b);
    const auto reach = [&] {
      return static_cast<float>(std::min(kFarthest, search.bound())) + leaves.planeRounding();
    };
    auto close = leaves.within(reach());
    if (close.of_a == 0) return false;
    leaves.keepWithin(reach(), search.direction(), close);  // keeps few if the surfaces are nearly parallel
    if (close.of_a == 0) return false;
    const TriangleLanes triangles_of_b(leaves);
    for (const std::uint32_t i : Lanes(close.of_a)) {
      const auto heights = triangles_of_b.heights(i);
      const unsigned near = triangles_of_b.within(reach(), heights, close.of[i]);
      if (near == 0) continue;
      const auto verdicts = triangles_of_b.meet(heights, near);
      for (const std::uint32_t j : Lanes(near)) {
        const bool may_meet = ((verdicts.meet | verdicts.open) >> j & 1u) != 0;
        if (may_meet) {
          if (search.offer({leaves.triangleA(i), leaves.triangleB(j)}, true)) return true;
        } else {
          pairs.add(leaves, i, j);
          if (pairs.isFull() && measure()) return true;
        }
      }
    }
    return !search.hasPair() && pairs.count() != 0 && measure();
  };
  // The queue finds a near pair early. If one is known, the stack is faster.
  const bool done = search.hasPair() ? walkPairs<TraversalStack>(a, b, pose, NodePair(), bound, limit, visit)
                                     : walkPairs<TraversalQueue>(a, b, pose, NodePair(), bound, limit, visit);
  if (!done && pairs.count() != 0) measure();
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
