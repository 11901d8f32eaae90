#include "octoblisk/closest_point.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/closest_point.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>

#include "query/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The distances from a point, in the tree's local frame, to eight boxes; infinite for empty boxes.
HWY_INLINE Float8 distances(const Box8& boxes, const Eigen::Vector3f& point) {
  const Vec8 offset{Float8(point.x()) - Float8::load(boxes.center[0]),
                    Float8(point.y()) - Float8::load(boxes.center[1]),
                    Float8(point.z()) - Float8::load(boxes.center[2])};
  Float8 squared(0.0f);
  for (int j = 0; j < 3; ++j) {
    const Vec8 axis{Float8::load(boxes.axes[0][j]), Float8::load(boxes.axes[1][j]),
                    Float8::load(boxes.axes[2][j])};
    const Float8 outside = max(abs(dot(axis, offset)) - Float8::load(boxes.half_extents[j]), Float8(0.0f));
    squared = squared + outside * outside;
  }
  return sqrt(squared);
}

std::optional<ClosestPoint> searchClosest(const Tree& tree, const Vec3& point, double upper_bound) {
  const LocalBox local(tree, {point, Mat3::Identity(), Vec3::Zero()});
  const double farthest = local.size;  // no triangle is farther away
  const double rounding = kSingleRounding * farthest;
  ClosestPoint best;
  best.distance = std::min(upper_bound, 2.0 * farthest);
  const auto squaredLimit = [](double distance) { return distance * distance * (1.0 + 1e-15); };
  double squared_limit = squaredLimit(best.distance);
  const auto gap = [](const Box8& boxes, const BoxF& at) HWY_ATTR { return distances(boxes, at.center); };
  const auto limit = [&] { return static_cast<float>(best.distance + rounding); };
  walkBox(tree, local, gap, limit, [&](Slot leaf) {
    for (const std::uint32_t t : tree.triangles(tree.child(leaf))) {
      const Vec3 on_triangle = closestPoint(tree.mesh().triangle(t), point);
      const double squared = (on_triangle - point).squaredNorm();
      if (squared > squared_limit) continue;
      const double distance = std::sqrt(squared);
      if (distance < best.distance || (distance == best.distance && t < best.triangle)) {
        best = {on_triangle, distance, t};
        squared_limit = squaredLimit(distance);
      }
    }
    return false;
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
