// Finds the triangle pairs of two trees that are near each other, leaf by leaf. Included once for each target
// (simd-inl.h).
#if defined(OCTOBLISK_QUERY_NEAR_PAIR_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_NEAR_PAIR_WALK_INL_H
#undef OCTOBLISK_QUERY_NEAR_PAIR_WALK_INL_H
#else
#define OCTOBLISK_QUERY_NEAR_PAIR_WALK_INL_H
#endif

#include "query/pair_distances-inl.h"
#include "query/traversal-inl.h"
#include "query/triangle_filter-inl.h"
#include "simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls visit(NearPair) for each triangle pair that may be within `threshold`; with a threshold of 0, only
/// if it may meet. `reach()` is the threshold at first, and may shrink.
template <typename Reach, typename Visit>
void forEachNearPair(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold, Reach&& reach,
                     Visit&& visit) {
  const LocalPose pose(a, b, b_in_a);
  const auto limitNow = [&] { return pose.limit(reach()); };
  PairDistances apart;
  std::array<NearPair, kLanes> near;
  const auto visitApart = [&]() HWY_ATTR {
    const std::uint32_t count = apart.nearPairs(limitNow(), near);
    for (std::uint32_t k = 0; k < count; ++k) visit(near[k]);
    apart.clear();
  };
  const auto visitLeaves = [&](Slot slot_a, Slot slot_b) HWY_ATTR {
    const float limit = limitNow();
    const LeafPair leaves(a, b, pose, slot_a, slot_b);
    const auto bounds = leaves.within(limit + 2.0f * leaves.coordinateRounding());
    if (bounds.of_a == 0) return false;
    const TriangleLanes triangles_of_b(leaves);
    for (const std::uint32_t i : Lanes(bounds.of_a)) {
      const auto heights = triangles_of_b.heights(i);
      const unsigned close = triangles_of_b.within(limit, heights, bounds.of[i]);
      if (close == 0) continue;
      const auto [meet, open] = triangles_of_b.meet(heights, close);
      for (const std::uint32_t j : Lanes(threshold > 0.0 ? close : meet | open)) {
        if (((meet | open) >> j & 1u) != 0) {
          NearPair pair;
          pair.triangles = {leaves.triangleA(i), leaves.triangleB(j)};
          if ((meet >> j & 1u) != 0) {
            pair.meeting = Meeting::yes;
            pair.most_distance = 0.0f;
          }
          visit(pair);
        } else {
          apart.add(leaves, i, j);
          if (apart.isFull()) visitApart();
        }
      }
    }
    return false;
  };
  walkPairs<TraversalStack>(a, b, pose, NodePair(), WidestGap(), limitNow, visitLeaves);
  if (apart.count() != 0) visitApart();
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
