// Tests a convex body against eight triangles of a leaf at once: which of them are certainly too far away.
// Included once for each target (simd-inl.h).
#if defined(OCTOBLISK_QUERY_CONVEX_CULL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef OCTOBLISK_QUERY_CONVEX_CULL_INL_H
#undef OCTOBLISK_QUERY_CONVEX_CULL_INL_H
#else
#define OCTOBLISK_QUERY_CONVEX_CULL_INL_H
#endif

#include <array>
#include <limits>
#include <span>

#include "base/rounding.h"
#include "geometry/core_points.h"
#include "simd/simd-inl.h"
#include "tree/node_boxes-inl.h"
#include "tree/tree.h"

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

/// The body is the hull of some points that contain its core. All computations use a frame around the middle
/// of the points.
class ConvexCull {
 public:
  /// For 1 to kMaxCorePoints points; boxes are relative to `origin`.
  ConvexCull(const Vec3& origin, std::span<const Vec3> points, const Aabb& bounds, const Pose& convex_in_tree)
      : count_(points.size()),
        half_extents_(bounds.halfExtents().cast<float>()),
        size_(bounds.halfExtents().norm()) {
    const Vec3 center = bounds.center();
    tree_in_center_.rotation = convex_in_tree.rotation.transpose();
    tree_in_center_.translation = tree_in_center_.rotation * (origin - convex_in_tree.translation) - center;
    rounding_ = kDoubleRounding * (origin.norm() + convex_in_tree.translation.norm() + center.norm());
    for (std::size_t p = 0; p < count_; ++p) points_[p] = (points[p] - center).cast<float>();
  }

  /// A bit for each triangle that may be within `reach` of the hull of the points. The corners are in rows
  /// (leaf_vertices.h) in the frame of a box.
  HWY_INLINE unsigned near(const BoxF& box, const float* rows, std::uint32_t count, double reach) const {
    const Vec3 shift = tree_in_center_ * box.center.cast<double>();
    const Eigen::Matrix3f turn = (tree_in_center_.rotation * box.axes.cast<double>()).cast<float>();
    Vec8 corner[3];
    for (std::uint32_t v = 0; v < 3; ++v) {
      const Vec8 local = Vec8::load(rows + 3 * v * count, count);
      const auto along = [&](int i) HWY_ATTR {
        return Float8(turn(i, 0)) * local.x + Float8(turn(i, 1)) * local.y + Float8(turn(i, 2)) * local.z +
               Float8(static_cast<float>(shift[i]));
      };
      corner[v] = {along(0), along(1), along(2)};
    }
    const double size = size_ + shift.norm() + 2.0 * double(box.half_extents.maxCoeff());
    const double wanted = reach + rounding_;
    const Float8 limit(static_cast<float>(wanted + 4.0 * kSingleRounding * (size + wanted)));
    unsigned near = (1u << count) - 1u;
    near &= ~beyondBounds(corner, limit);
    if (near != 0) near &= ~apartAlong(cross(corner[1] - corner[0], corner[2] - corner[0]), corner, limit);
    return notParted(near, corner, limit);
  }

 private:
  /// The triangles beyond the reach of the box around the points.
  HWY_INLINE unsigned beyondBounds(const Vec8 (&corner)[3], const Float8& reach) const {
    const Vec8 low = min(corner[0], min(corner[1], corner[2])),
               high = max(corner[0], max(corner[1], corner[2]));
    const auto beyond = [&](int axis, const Float8& from, const Float8& to) HWY_ATTR {
      const Float8 farthest = Float8(half_extents_[axis]) + reach;
      return less(farthest, from) | less(to, Float8(0.0f) - farthest);
    };
    return beyond(0, low.x, high.x) | beyond(1, low.y, high.y) | beyond(2, low.z, high.z);
  }

  /// The triangles that are beyond the reach along an axis of any length.
  HWY_INLINE unsigned apartAlong(const Vec8& axis, const Vec8 (&corner)[3], const Float8& reach) const {
    const Float8 at[3] = {dot(axis, corner[0]), dot(axis, corner[1]), dot(axis, corner[2])};
    Float8 low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
    for (std::size_t p = 0; p < count_; ++p) {
      const Float8 along = dot(axis, Vec8::all(points_[p]));
      low = min(low, along);
      high = max(high, along);
    }
    const Float8 gap = max(low - max(at[0], max(at[1], at[2])), min(at[0], min(at[1], at[2])) - high);
    // At least the axis's length, however short: its square may underflow.
    const Float8 length = sqrt(dot(axis, axis) + Float8(std::numeric_limits<float>::min()));
    return less(reach * length, gap);
  }

  /// `yes` in the lanes where a < b, otherwise `no`.
  static HWY_INLINE Vec8 either(const Float8& a, const Float8& b, const Vec8& yes, const Vec8& no) {
    return {select(a, b, yes.x, no.x), select(a, b, yes.y, no.y), select(a, b, yes.z, no.z)};
  }

  /// The triangles of `near` that remain after a search for a plane between each triangle and the body: a few
  /// steps of the conditional gradient on their Minkowski difference (M. Frank, P. Wolfe, 1956).
  HWY_INLINE unsigned notParted(unsigned near, const Vec8 (&corner)[3], const Float8& reach) const {
    constexpr int kSteps = 4;
    const Float8 zero(0.0f), one(1.0f), tiny(std::numeric_limits<float>::min());
    // A point of the difference, if the middle of the points' box is in the body.
    Vec8 apart = (corner[0] + corner[1] + corner[2]) * Float8(1.0f / 3.0f);
    unsigned open = near;
    for (int step = 0; step < kSteps; ++step) {
      // At least the length, however short: its square may underflow.
      const Float8 length = sqrt(dot(apart, apart) + tiny);
      open &= less(reach, length);  // the others are within reach, or may be
      if (open == 0) break;
      Float8 low = dot(apart, corner[0]);
      Vec8 on_triangle = corner[0];
      for (int c = 1; c < 3; ++c) {
        const Float8 along = dot(apart, corner[c]);
        on_triangle = either(along, low, corner[c], on_triangle);
        low = min(low, along);
      }
      Float8 high(-std::numeric_limits<float>::infinity());
      Vec8 on_body(zero, zero, zero);
      for (std::size_t p = 0; p < count_; ++p) {
        const Vec8 point = Vec8::all(points_[p]);
        const Float8 along = dot(apart, point);
        on_body = either(high, along, point, on_body);
        high = max(high, along);
      }
      const unsigned parted = open & less(reach * length, low - high);
      near &= ~parted;
      open &= ~parted;
      const Vec8 way = (on_triangle - on_body) - apart;
      const Float8 part = min(one, max(zero, (zero - dot(apart, way)) / (dot(way, way) + tiny)));
      apart = apart + way * part;
    }
    return near;
  }

  std::array<Eigen::Vector3f, kMaxCorePoints> points_;  // relative to their middle
  std::size_t count_;
  Pose tree_in_center_;  // from the tree's local frame
  Eigen::Vector3f half_extents_;
  double size_, rounding_;
};

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
