// Tests a point against eight triangles of a leaf at once: which of them are certainly too far away. Included
// once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_POINT_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_POINT_CULL_INL_H
#undef OCTOBLISK_QUERY_POINT_CULL_INL_H
#else
#define OCTOBLISK_QUERY_POINT_CULL_INL_H
#endif

#include "base/rounding.h"
#include "simd/triangle8-inl.h"
#include "simd/unit.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// Like ConvexCull, for a body whose core is a point. Computes all eight distances in single precision.
class PointCull {
 public:
  /// Boxes are relative to `origin`. Without a pose, the point is in the tree's frame.
  PointCull(const Vec3& origin, const Vec3& point, const Pose& convex_in_tree = {})
      : point_(convex_in_tree * point - origin),
        rounding_(kDoubleRounding * (origin.norm() + convex_in_tree.translation.norm() + point.norm())) {}

  /// A bit for each triangle that may be within `reach` of the point. The corners are in rows
  /// (leaf_vertices.h) in the frame of a box.
  HWY_INLINE unsigned near(const BoxF& box, const float* rows, std::uint32_t count, double reach) const {
    const Vec3 point_in_box = box.axes.cast<double>().transpose() * (point_ - box.center.cast<double>());
    const double size = point_in_box.norm() + 2.0 * double(box.half_extents.maxCoeff());
    const Float8 unit(unitOf(static_cast<float>(size)));
    const Vec8 point = Vec8::all(point_in_box);
    const auto corner = [&](std::uint32_t v) HWY_ATTR {
      const Vec8 in_box = Vec8::load(rows + 3 * v * count, count);
      return (in_box - point) * unit;
    };
    const Triangle8 triangles(corner(0), corner(1), corner(2));
    const Vec8 origin(Float8(0.0f), Float8(0.0f), Float8(0.0f));  // the point
    Float8 squared = squaredFaceDistance(origin, triangles);
    for (int v = 0; v < 3; ++v)
      squared = min(squared, squaredEdgeDistance(triangles.corner[v], triangles.edge[v]));
    constexpr double kSubnormal = 0x1p-120;  // above the steps of subnormal numbers
    const double wanted = reach + rounding_;
    const Float8 limit(static_cast<float>(wanted + 4.0 * kSingleRounding * (size + wanted) + kSubnormal));
    return ((1u << count) - 1u) & ~less(limit * unit, sqrt(squared) - triangles.thin);
  }

 private:
  /// The squared distance of the origin to the edge that starts at `from`.
  static HWY_INLINE Float8 squaredEdgeDistance(const Vec8& from, const Edge8& edge) {
    const Float8 part = clamped01((Float8(0.0f) - dot(from, edge.along)) * edge.reciprocal);
    const Vec8 closest = from + edge.along * part;
    return dot(closest, closest);
  }

  Vec3 point_;  // in the tree's local frame
  double rounding_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
