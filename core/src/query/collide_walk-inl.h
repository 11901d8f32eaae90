// Finds all triangle pairs of two trees that meet, one by one. Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_COLLIDE_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_COLLIDE_WALK_INL_H
#undef OCTOBLISK_QUERY_COLLIDE_WALK_INL_H
#else
#define OCTOBLISK_QUERY_COLLIDE_WALK_INL_H
#endif

#include "geometry/triangle_pair.h"
#include "octoblisk/contact.h"
#include "query/tally.h"
#include "query/traversal-inl.h"
#include "query/triangle_filter-inl.h"
#include "simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Calls visit(pair, meets) for each pair of triangles of two leaves that the filter does not separate.
/// `meets`: the filter proves that they meet; otherwise the exact test must decide. Returns true as soon as a
/// visit does, otherwise false.
template <typename Visit, typename Tally = NoTally>
HWY_INLINE bool forEachCandidateInLeaves(const Tree& a, const Tree& b, const LocalPose& pose, Slot slot_a,
                                         Slot slot_b, Visit&& visit, Tally&& tally = {}) {
  tally.leafPair();
  const LeafPair leaves(a, b, pose, slot_a, slot_b);
  const auto near = leaves.within(2.0f * leaves.coordinateRounding());
  if (near.of_a == 0) return false;
  const TriangleLanes triangles_of_b(leaves);
  for (const std::uint32_t i : Lanes(near.of_a)) {
    tally.triangleTest();
    const auto verdicts = triangles_of_b.meet(triangles_of_b.heights(i), near.of[i]);
    for (const std::uint32_t j : Lanes(verdicts.meet | verdicts.open)) {
      const TrianglePair pair{leaves.triangleA(i), leaves.triangleB(j)};
      if (visit(pair, (verdicts.meet >> j & 1u) != 0)) return true;
    }
  }
  return false;
}

/// Calls visit(pair, nodes, meets) like forEachCandidateInLeaves, for all leaves below two nodes for which
/// `wants` is true. `nodes` are the nodes whose leaves contain the pair.
template <typename Wants, typename Visit, typename Tally = NoTally>
bool walkCandidatePairs(const Tree& a, const Tree& b, const Pose& b_in_a, NodePair below, Wants&& wants,
                        Visit&& visit, Tally&& tally = {}) {
  const LocalPose pose(a, b, b_in_a);
  const auto gap = [&](const Box8& boxes, const BoxF& box) HWY_ATTR {
    tally.boxTest();
    return widestGap(boxes, box);
  };
  return walkPairs<TraversalStack>(
      a, b, pose, below, gap, [limit = pose.limit(0.0)] { return limit; },
      [&](Slot slot_a, Slot slot_b) HWY_ATTR {
        if (!wants(slot_a, slot_b)) return false;
        const auto visitPair = [&](const TrianglePair& pair, bool meets) HWY_ATTR {
          return visit(pair, NodePair{slot_a.node, slot_b.node}, meets);
        };
        return forEachCandidateInLeaves(a, b, pose, slot_a, slot_b, visitPair, tally);
      });
}

/// All pairs of leaves.
inline constexpr auto kAnyLeaves = [](Slot, Slot) { return true; };

/// Calls visit(pair, nodes) for every pair of triangles below two nodes that meet. Returns true as soon as a
/// visit does, otherwise false.
template <typename Visit, typename Tally = NoTally>
bool forEachMeetingPair(const Tree& a, const Tree& b, const Pose& b_in_a, NodePair below, Visit&& visit,
                        Tally&& tally = {}) {
  const auto settle = [&](TrianglePair pair, NodePair nodes, bool meets) HWY_ATTR {
    if (!meets) {
      tally.exactTest();
      if (!intersects(a.mesh(), b.mesh(), b_in_a, pair)) return false;
    }
    return static_cast<bool>(visit(pair, nodes));
  };
  return walkCandidatePairs(a, b, b_in_a, below, kAnyLeaves, settle, tally);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
