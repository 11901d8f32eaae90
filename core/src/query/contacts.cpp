#include "octoblisk/contacts.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/contacts.cpp"
#include <hwy/foreach_target.h>

#include "query/near_pair_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void appendContacts(const Tree& a, const Tree& b, const Pose& b_in_a, double threshold,
                    std::vector<Contact>& found) {
  const auto reach = [threshold] { return threshold; };
  forEachNearPair(a, b, b_in_a, threshold, reach, [&](const NearPair& pair) {
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
