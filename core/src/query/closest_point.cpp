#include "octoblisk/closest_point.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/closest_point.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>

#include "query/leaf_triangles-inl.h"
#include "query/point_cull-inl.h"
#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

std::optional<ClosestPoint> searchClosest(const Tree& tree, const Vec3& point, double upper_bound) {
  const LocalBox local(tree, {point, Mat3::Identity(), Vec3::Zero()});
  const double farthest = local.size;  // no triangle is farther away
  const double rounding = kSingleRounding * farthest + local.doubles;
  ClosestPoint best;
  best.distance = std::min(upper_bound, 2.0 * farthest);
  const auto squaredLimit = [](double distance) { return distance * distance * (1.0 + 1e-15); };
  double squared_limit = squaredLimit(best.distance);
  const auto limit = [&] { return static_cast<float>(best.distance + rounding); };
  const PointCull cull(tree.origin(), point);
  walkBox(tree, local, GapOfPoint(), limit, [&](Slot leaf) HWY_ATTR {
    return forEachNearInLeaf(tree, leaf, cull, best.distance, [&](std::uint32_t t) {
      const Vec3 on_triangle = closestPoint(tree.mesh().triangle(t), point);
      const double squared = (on_triangle - point).squaredNorm();
      if (squared > squared_limit) return false;
      const double distance = std::sqrt(squared);
      if (distance < best.distance || (distance == best.distance && t < best.triangle)) {
        best = {on_triangle, distance, t};
        squared_limit = squaredLimit(distance);
      }
      return false;
    });
  });
  if (best.triangle == kNoTriangle) return std::nullopt;
  return best;
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk {

using namespace detail;

HWY_EXPORT(searchClosest);

std::optional<ClosestPoint> closestPoint(const ClusteredOctree& tree, const Vec3& point, double upper_bound) {
  return HWY_DYNAMIC_DISPATCH(searchClosest)(treeOf(tree), point, upper_bound);
}

}  // namespace octoblisk
#endif
