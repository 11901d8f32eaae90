#include "octoblisk/contacts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/contacts.cpp"
#include <hwy/foreach_target.h>

#include "geometry/triangle_pair.h"
#include "query/pair_distances-inl.h"
#include "query/traversal-inl.h"
#include "query/triangle_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void appendContacts(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                    std::vector<Contact>& found) {
  const LocalPose pose(a, b, b_in_a);
  const float limit = pose.limit(threshold);
  const auto append = [&](const TrianglePair& pair,
                          Contact (*contactOfPair)(const Triangle&, const Triangle&)) {
    Contact contact = contactOfPair(a.mesh().triangle(pair.a), b_in_a * b.mesh().triangle(pair.b));
    if (contact.distance > threshold) return;
    contact.triangle_a = pair.a;
    contact.triangle_b = pair.b;
    found.push_back(contact);
  };
  PairDistances apart;
  const auto appendApart = [&]() HWY_ATTR {
    const DistanceBounds8 bounds = apart.bounds();
    for (std::uint32_t k = 0; k < apart.count(); ++k) {
      if (!(bounds.least[k] > limit)) append(apart.pairs()[k], closestPoints);
    }
    apart.clear();
  };
  walkPairs<TraversalStack>(
      a, b, pose, NodePair(), WidestGap(), [&] { return limit; },
      [&](Slot slot_a, Slot slot_b) HWY_ATTR {
        const LeafPair leaves(a, b, pose, slot_a, slot_b);
        auto bounds = leaves.within(limit + 2.0f * leaves.coordinateRounding());
        if (bounds.of_a == 0) return false;
        const TriangleLanes triangles_of_b(leaves);
        for (; bounds.of_a != 0; bounds.of_a &= bounds.of_a - 1) {
          const auto i = static_cast<std::uint32_t>(std::countr_zero(bounds.of_a));
          const auto heights = triangles_of_b.heights(i);
          const unsigned near = triangles_of_b.within(limit, heights, bounds.of[i]);
          if (near == 0) continue;
          const auto [meet, open] = triangles_of_b.meet(heights, near);
          for (unsigned left = threshold > 0.0 ? near : meet | open; left != 0; left &= left - 1) {
            const auto j = static_cast<std::uint32_t>(std::countr_zero(left));
            const TrianglePair pair{leaves.triangleA(i), leaves.triangleB(j)};
            if ((meet >> j & 1u) != 0) {
              append(pair, meetingContact);
            } else if ((open >> j & 1u) != 0) {
              append(pair, contactOf);
            } else {
              apart.add(leaves, i, j);
              if (apart.isFull()) appendApart();
            }
          }
        }
        return false;
      });
  if (apart.count() != 0) appendApart();
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

#include "geometry/triangle_convex.h"
#include "octoblisk/triangles_near_convex.h"

namespace octoblisk {

using namespace detail;

namespace {

HWY_EXPORT(appendContacts);

void sortByTriangles(std::vector<Contact>& found) {
  std::ranges::sort(found, {}, [](const Contact& c) { return TrianglePair{c.triangle_a, c.triangle_b}; });
}

/// forEachTriangle(visit) calls `visit` for every triangle that may be near, as long as it returns false.
template <typename ForEach>
void findConvexContacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
                        std::vector<Contact>& found, ForEach&& forEachTriangle) {
  found.clear();
  const Pose a_in_b = b_in_a.inverse();
  forEachTriangle([&](std::uint32_t triangle) {
    std::optional<Contact> contact = contactOf(a_in_b * a.mesh().triangle(triangle), b, threshold);
    if (!contact) return false;
    contact->point_on_a = b_in_a * contact->point_on_a;
    contact->point_on_b = b_in_a * contact->point_on_b;
    contact->normal = b_in_a.rotation * contact->normal;
    contact->triangle_a = triangle;
    found.push_back(*contact);
    return false;
  });
  sortByTriangles(found);
}

}  // namespace

void contacts(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  found.clear();
  HWY_DYNAMIC_DISPATCH(appendContacts)(treeOf(a), treeOf(b), b_in_a, threshold, found);
  sortByTriangles(found);
}

void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found) {
  findConvexContacts(a, b, b_in_a, threshold, found,
                     [&](auto&& visit) { forEachTriangleNear(a, b, b_in_a, threshold, visit); });
}

void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              TriangleCache& near, std::vector<Contact>& found) {
  findConvexContacts(a, b, b_in_a, threshold, found, [&](auto&& visit) {
    for (const std::uint32_t triangle : near.find(a, b, b_in_a, threshold)) visit(triangle);
  });
}

}  // namespace octoblisk
#endif
