#include "octoblisk/distance.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/distance.cpp"
#include <hwy/foreach_target.h>

#include "query/distance_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void searchPairs(const Tree& a, const Tree& b, const Pose& b_in_a, DistanceSearch& search) {
  searchNearest(a, b, b_in_a, search);
}

void searchConvex(const Tree& a, const Obb& bounds_of_b, ConvexDistanceSearch& search) {
  const LocalBox local(a, bounds_of_b);
  const auto bound = [](const Box8& boxes, const BoxF& box)
                         HWY_ATTR { return squaredDistanceBound(boxes, box); };
  const auto limit = [&] { return squaredLimit(search.bound() + local.doubles, local.size); };
  walkBox(a, local, bound, limit, [&](Slot slot) {
    for (const std::uint32_t triangle : a.triangles(a.child(slot))) {
      if (search.offer(triangle)) return true;
    }
    return false;
  });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

using namespace detail;

HWY_EXPORT(searchPairs);
HWY_EXPORT(searchConvex);

Clearance distance(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   const DistanceOptions& options) {
  DistanceSearch search(a.mesh(), b.mesh(), b_in_a, options);
  const auto within = [](std::uint32_t triangle, const ClusteredOctree& tree) {
    return triangle < tree.mesh().triangleCount();
  };
  const bool hinted = within(options.hint.a, a) && within(options.hint.b, b) && b_in_a.isFinite();
  if (!hinted || !search.offer(options.hint, true))
    HWY_DYNAMIC_DISPATCH(searchPairs)(treeOf(a), treeOf(b), b_in_a, search);
  return search.settled();
}

Clearance distance(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a,
                   const DistanceOptions& options) {
  ConvexDistanceSearch search(a.mesh(), b, b_in_a, options);
  const bool hinted = options.hint.a < a.mesh().triangleCount() && b_in_a.isFinite();
  const Obb box = b_in_a * obbOf(b.bounds());
  if (!hinted || !search.offer(options.hint.a)) HWY_DYNAMIC_DISPATCH(searchConvex)(treeOf(a), box, search);
  return search.clearance();
}

}  // namespace octoblisk
#endif
