#include "octoblisk/collide.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/collide.cpp"
#include <hwy/foreach_target.h>

#include "query/candidate_pairs.h"
#include "query/collide_below.h"
#include "query/collide_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

std::optional<MeetingPair> firstPair(const Tree& a, const Tree& b, const Pose& b_in_a, NodePair below) {
  std::optional<MeetingPair> hit;
  forEachMeetingPair(a, b, b_in_a, below, [&](TrianglePair pair, NodePair nodes) {
    hit = {pair, nodes};
    return true;
  });
  return hit;
}

void candidatePairs(const Tree& a, const Tree& b, const Pose& b_in_a,
                    FunctionRef<void(CandidatePair pair)> visit) {
  walkCandidatePairs(a, b, b_in_a, NodePair(), kAnyLeaves, [&](TrianglePair pair, NodePair, bool meets) {
    visit({pair, meets});
    return false;
  });
}

void candidatePairsWithin(const Tree& tree, FunctionRef<void(CandidatePair pair)> visit) {
  bool is_one_leaf = false;
  const auto isFirstOrder = [&](Slot a, Slot b) {
    is_one_leaf = a.node == b.node && a.lane == b.lane;
    return a.node < b.node || (a.node == b.node && a.lane <= b.lane);
  };
  walkCandidatePairs(tree, tree, Pose(), NodePair(), isFirstOrder,
                     [&](TrianglePair pair, NodePair, bool meets) {
                       if (!is_one_leaf || pair.a < pair.b) visit({pair, meets});
                       return false;
                     });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "geometry/triangle_convex.h"
#include "octoblisk/triangles_near_convex.h"

namespace octoblisk {

using namespace detail;

HWY_EXPORT(firstPair);
HWY_EXPORT(candidatePairs);
HWY_EXPORT(candidatePairsWithin);

std::optional<MeetingPair> detail::collideBelow(const Tree& a, const Tree& b, const Pose& b_in_a,
                                                NodePair below) {
  return HWY_DYNAMIC_DISPATCH(firstPair)(a, b, b_in_a, below);
}

void detail::forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a,
                                  FunctionRef<void(CandidatePair pair)> visit) {
  HWY_DYNAMIC_DISPATCH(candidatePairs)(a, b, b_in_a, visit);
}

void detail::forEachCandidatePairWithin(const Tree& tree, FunctionRef<void(CandidatePair pair)> visit) {
  HWY_DYNAMIC_DISPATCH(candidatePairsWithin)(tree, visit);
}

bool detail::meet(const Tree& a, const Tree& b, const Pose& b_in_a, const CandidatePair& pair) {
  return pair.meets || intersects(a.mesh(), b.mesh(), b_in_a, pair.triangles);
}

std::optional<TrianglePair> collide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  const std::optional<MeetingPair> hit = collideBelow(treeOf(a), treeOf(b), b_in_a, NodePair());
  return hit ? std::optional(hit->triangles) : std::nullopt;
}

void touchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   std::vector<TrianglePair>& found) {
  found.clear();
  forEachCandidatePair(treeOf(a), treeOf(b), b_in_a, [&](const CandidatePair& pair) {
    if (meet(treeOf(a), treeOf(b), b_in_a, pair)) found.push_back(pair.triangles);
  });
  std::ranges::sort(found);
}

std::optional<std::uint32_t> collide(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a) {
  std::optional<std::uint32_t> hit;
  const PosedConvex posed(b, b_in_a);
  forEachTriangleNear(a, b, b_in_a, 0.0, [&](std::uint32_t triangle) {
    if (!posed.contactWith(a.mesh().triangle(triangle), 0.0)) return false;
    hit = triangle;
    return true;
  });
  return hit;
}

}  // namespace octoblisk
#endif
