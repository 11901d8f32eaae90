#include "octoblisk/closest_point.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/closest_point.cpp"
#include <hwy/foreach_target.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/traversal-inl.h"
#include "simd/triangle8-inl.h"

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

/// Lower bounds of the distances from a point, in the tree's local frame, to the triangles of a leaf;
/// arbitrary in the lanes beyond them.
HWY_INLINE Float8 leastDistances(const Tree& tree, Slot leaf, const Vec3& point) {
  Box8 box_room(Box8::Unset{});
  LeafVertices room;
  const BoxF box = boxesAt(tree, leaf, box_room).get(static_cast<int>(leaf.lane));
  const float* const rows = tree.leafVertices(leaf, room);
  const std::uint32_t count = tree.child(leaf).count();
  const Eigen::Vector3f at =
      (box.axes.cast<double>().transpose() * (point - box.center.cast<double>())).cast<float>();
  // In this unit of length, no power overflows, and underflow is far below the rounding. The last term avoids
  // a division by 0.
  const float size = at.cwiseAbs().sum() + box.half_extents.maxCoeff() + std::numeric_limits<float>::min();
  const Float8 unit(1.0f / size);
  const auto corner = [&](std::uint32_t v) HWY_ATTR {
    const float* const x = rows + 3 * v * count;
    return Vec8(Float8::load(x) - Float8(at.x()), Float8::load(x + count) - Float8(at.y()),
                Float8::load(x + 2 * count) - Float8(at.z())) *
           unit;
  };
  const Triangle8 triangles(corner(0), corner(1), corner(2));
  const Vec8 origin(Float8(0.0f), Float8(0.0f), Float8(0.0f));
  Float8 squared = squaredFaceDistance(origin, triangles);
  for (int v = 0; v < 3; ++v) {
    squared = min(squared, squaredEdgeDistance(origin, triangles.corner[v], triangles.edge[v]));
  }
  // Errors in units in the last place of the size: a normal is off by up to 3.2 over the sine of the
  // triangle's angle, and that sine is at least 2^-5 unless the triangle is thin. A corner is up to 1.74
  // sizes away, so a height is off by up to 178. The box's axes are not exactly orthonormal: 45. Corners: 6.
  // Sums and roots: 20. All in all less than 2^8 of 2^9.
  constexpr float kRounding = 0x1p-15f;
  return (sqrt(squared) - triangles.thin - Float8(kRounding)) * Float8(size);
}

std::optional<ClosestPoint> searchClosest(const Tree& tree, const Vec3& point, double upper_bound) {
  const LocalBox local(tree, {point, Mat3::Identity(), Vec3::Zero()});
  const double farthest = local.size;  // no triangle is farther away
  const double rounding =
      kSingleRounding * farthest + kDoubleRounding * (tree.origin().norm() + point.norm());
  ClosestPoint best;
  best.distance = std::min(upper_bound, 2.0 * farthest);
  const auto squaredLimit = [](double distance) { return distance * distance * (1.0 + 1e-15); };
  double squared_limit = squaredLimit(best.distance);
  const auto gap = [](const Box8& boxes, const BoxF& at) HWY_ATTR { return distances(boxes, at.center); };
  const auto limit = [&] { return static_cast<float>(best.distance + rounding); };
  const Vec3 from_origin = point - tree.origin();
  walkBox(tree, local, gap, limit, [&](Slot leaf) HWY_ATTR {
    const std::span<const std::uint32_t> triangles = tree.triangles(tree.child(leaf));
    float bounds[kLanes];
    leastDistances(tree, leaf, from_origin).store(bounds);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      if (bounds[i] > limit()) continue;
      const std::uint32_t t = triangles[i];
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
