#include "octoblisk/collide.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/collide.cpp"
#include <hwy/foreach_target.h>

#include "query/candidate_pairs.h"
#include "query/collide_below.h"
#include "query/collide_walk-inl.h"
#include "query/self_meetings.h"

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

void allPairs(const Tree& a, const Tree& b, const Pose& b_in_a, std::vector<TrianglePair>& found) {
  forEachMeetingPair(a, b, b_in_a, NodePair(), [&](TrianglePair pair, NodePair) {
    found.push_back(pair);
    return false;
  });
}

void candidatePairs(const Tree& a, const Tree& b, const Pose& b_in_a,
                    void (*visit)(void* user, CandidatePair pair), void* user) {
  forEachCandidatePair(a, b, b_in_a, NodePair(), [&](TrianglePair pair, NodePair, bool meets) {
    visit(user, {pair, meets});
    return false;
  });
}

void selfMeetings(const Surface& surface, std::vector<char>& meets) {
  const Tree& tree = treeOf(surface.tree());
  const auto sharesNoCorner = [&](TrianglePair pair) {
    if (pair.a >= pair.b) return false;
    for (const std::uint32_t corner : surface.corners(pair.a)) {
      if (std::ranges::find(surface.corners(pair.b), corner) != surface.corners(pair.b).end()) return false;
    }
    return true;
  };
  const auto note = [&](TrianglePair pair, NodePair) {
    meets[pair.a] = meets[pair.b] = 1;
    return false;
  };
  forEachMeetingPair(tree, tree, Pose(), NodePair(), note, NoTally(), sharesNoCorner);
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "geometry/triangle_convex.h"
#include "octoblisk/triangles_near_convex.h"

namespace octoblisk {

using namespace detail;

HWY_EXPORT(firstPair);
HWY_EXPORT(allPairs);
HWY_EXPORT(candidatePairs);
HWY_EXPORT(selfMeetings);

std::optional<MeetingPair> detail::collideBelow(const Tree& a, const Tree& b, const Pose& b_in_a,
                                                NodePair below) {
  return HWY_DYNAMIC_DISPATCH(firstPair)(a, b, b_in_a, below);
}

void detail::forEachCandidatePair(const Tree& a, const Tree& b, const Pose& b_in_a,
                                  void (*visit)(void* user, CandidatePair pair), void* user) {
  HWY_DYNAMIC_DISPATCH(candidatePairs)(a, b, b_in_a, visit, user);
}

void detail::findSelfMeetings(const Surface& surface, std::vector<char>& meets) {
  HWY_DYNAMIC_DISPATCH(selfMeetings)(surface, meets);
}

std::optional<TrianglePair> collide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  const std::optional<MeetingPair> hit = collideBelow(treeOf(a), treeOf(b), b_in_a, NodePair());
  return hit ? std::optional(hit->triangles) : std::nullopt;
}

void touchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   std::vector<TrianglePair>& found) {
  found.clear();
  HWY_DYNAMIC_DISPATCH(allPairs)(treeOf(a), treeOf(b), b_in_a, found);
  std::ranges::sort(found);
}

std::optional<std::uint32_t> collide(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a) {
  std::optional<std::uint32_t> hit;
  const Pose a_in_b = b_in_a.inverse();
  forEachTriangleNear(a, b, b_in_a, 0.0, [&](std::uint32_t triangle) {
    const auto contact = contactOf(a_in_b * a.mesh().triangle(triangle), b, 0.0);
    if (!contact || contact->distance > 0.0) return false;
    hit = triangle;
    return true;
  });
  return hit;
}

}  // namespace octoblisk
#endif
