#include "octoblisk/contacts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/contacts.cpp"
#include <hwy/foreach_target.h>

#include <optional>

#include "geometry/triangle_pair.h"
#include "query/pair_distances-inl.h"
#include "query/traversal-inl.h"
#include "query/triangle_filter-inl.h"
#include "simd/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

enum class Meeting : std::uint8_t { no, maybe, yes };

/// Two triangles that may be near each other.
struct NearPair {
  TrianglePair triangles;
  Meeting meeting = Meeting::maybe;
};

/// The contact of two near triangles; none if they are farther apart than `threshold`.
std::optional<Contact> contactWithin(double threshold, const NearPair& near, const Triangle& a,
                                     const Triangle& b) {
  const bool meet = near.meeting == Meeting::yes || (near.meeting == Meeting::maybe && intersects(a, b));
  if (!meet && !(threshold > 0.0)) return std::nullopt;
  Contact contact = meet ? meetingContact(a, b) : closestPoints(a, b);
  if (contact.distance > threshold) return std::nullopt;
  contact.triangle_a = near.triangles.a;
  contact.triangle_b = near.triangles.b;
  return contact;
}

/// Calls visit(NearPair) for each triangle pair that may be within `threshold`; with a threshold of 0, only
/// if it may meet.
template <typename Visit>
void forEachNearPair(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold, Visit&& visit) {
  const LocalPose pose(a, b, b_in_a);
  const float limit = pose.limit(threshold);
  PairDistances apart;
  const auto visitApart = [&]() HWY_ATTR {
    for (const std::uint32_t k : Lanes(apart.within(limit))) visit(NearPair{apart.pairs()[k], Meeting::no});
    apart.clear();
  };
  const auto visitLeaves = [&](Slot slot_a, Slot slot_b) HWY_ATTR {
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
          const Meeting meeting = (meet >> j & 1u) != 0 ? Meeting::yes : Meeting::maybe;
          visit(NearPair{{leaves.triangleA(i), leaves.triangleB(j)}, meeting});
        } else {
          apart.add(leaves, i, j);
          if (apart.isFull()) visitApart();
        }
      }
    }
    return false;
  };
  walkPairs<TraversalStack>(
      a, b, pose, NodePair(), WidestGap(), [limit] { return limit; }, visitLeaves);
  if (apart.count() != 0) visitApart();
}

void appendContacts(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                    std::vector<Contact>& found) {
  forEachNearPair(a, b, b_in_a, threshold, [&](const NearPair& pair) {
    const Triangle of_a = a.mesh().triangle(pair.triangles.a),
                   of_b = b_in_a * b.mesh().triangle(pair.triangles.b);
    if (const std::optional<Contact> contact = contactWithin(threshold, pair, of_a, of_b)) {
      found.push_back(*contact);
    }
  });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

#include "geometry/triangle_convex.h"
#include "octoblisk/triangles_near_convex.h"
#include "query/by_triangles.h"

namespace octoblisk {

using namespace detail;

namespace {

HWY_EXPORT(appendContacts);

/// forEachTriangle(visit) calls `visit` for every triangle that may be near, as long as it returns false.
template <typename ForEach>
void findConvexContacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
                        std::vector<Contact>& found, ForEach&& forEachTriangle) {
  found.clear();
  const PosedConvex posed(b, b_in_a);
  forEachTriangle([&](std::uint32_t triangle) {
    if (const std::optional<Contact> contact = posed.contactWith(a.mesh().triangle(triangle), threshold)) {
      found.push_back(*contact);
      found.back().triangle_a = triangle;
    }
    return false;
  });
  std::ranges::sort(found, {}, byTriangles);
}

}  // namespace

void contacts(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  found.clear();
  HWY_DYNAMIC_DISPATCH(appendContacts)(treeOf(a), treeOf(b), b_in_a, threshold, found);
  std::ranges::sort(found, {}, byTriangles);
}

void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  findConvexContacts(a, b, b_in_a, threshold, found,
                     [&](auto&& visit) { forEachTriangleNear(a, b, b_in_a, threshold, visit); });
}

void contacts(const ClusteredOctree& a, std::span<const std::uint32_t> triangles_of_a, const Convex& b,
              const Pose& b_in_a, double threshold, std::vector<Contact>& found) {
  findConvexContacts(a, b, b_in_a, threshold, found, [&](auto&& visit) {
    found.reserve(triangles_of_a.size());
    if (b_in_a.isFinite()) std::ranges::for_each(triangles_of_a, visit);
  });
}

}  // namespace octoblisk
#endif
