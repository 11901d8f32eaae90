#include "octoblisk/distance.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/distance.cpp"
#include <hwy/foreach_target.h>

#include "query/distance_walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

void searchPairs(const Tree& a, const Tree& b, const Pose& b_in_a, DistanceSearch& nearest) {
  searchNearest(a, b, b_in_a, nearest);
}

void searchConvex(const Tree& a, const Obb& bounds_of_b, ConvexDistanceSearch& nearest) {
  const LocalBox local(a, bounds_of_b);
  const auto bound = [](const Box8& boxes, const BoxF& box)
                         HWY_ATTR { return squaredDistanceBound(boxes, box); };
  const auto limit = [&] { return squaredLimit(nearest.bound() + local.doubles, local.size); };
  walkBox(a, local, bound, limit, [&](Slot slot) {
    for (const std::uint32_t triangle : a.triangles(a.child(slot))) {
      if (nearest.offer(triangle)) return true;
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
  DistanceSearch nearest(a.mesh(), b.mesh(), b_in_a, options);
  const auto within = [](std::uint32_t triangle, const ClusteredOctree& tree) {
    return triangle < tree.mesh().triangleCount();
  };
  const bool hinted = within(options.hint.a, a) && within(options.hint.b, b) && b_in_a.isFinite();
  if (!hinted || !nearest.offer(options.hint, true))
    HWY_DYNAMIC_DISPATCH(searchPairs)(treeOf(a), treeOf(b), b_in_a, nearest);
  return nearest.settled();
}

Clearance distance(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a,
                   const DistanceOptions& options) {
  ConvexDistanceSearch nearest(a.mesh(), b, b_in_a, options);
  const bool hinted = options.hint.a < a.mesh().triangleCount() && b_in_a.isFinite();
  const Obb box = b_in_a * obbOf(b.bounds());
  if (!hinted || !nearest.offer(options.hint.a)) HWY_DYNAMIC_DISPATCH(searchConvex)(treeOf(a), box, nearest);
  return nearest.clearance();
}

}  // namespace octoblisk
#endif
