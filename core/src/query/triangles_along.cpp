#include "query/triangles_along.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/triangles_along.cpp"
#include <hwy/foreach_target.h>

#include "geometry/frame_along.h"
#include "query/leaf_triangles-inl.h"
#include "query/traversal-inl.h"

#ifndef OCTOBLISK_QUERY_TRIANGLES_ALONG_ONCE
#define OCTOBLISK_QUERY_TRIANGLES_ALONG_ONCE
namespace octoblisk::detail {

/// The fractions at which a moving box overlaps an object along all axes tested so far.
class OverlapInterval {
 public:
  /// Narrows the interval by one axis, of any length. The object lies within low..high; the box's centre
  /// starts at 0, moves by `motion` and extends `radius` to either side.
  void narrow(double low, double high, double motion, double radius) {
    const double to_low = low - radius, to_high = high + radius;
    if (motion == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) first_ = kNever;
      return;
    }
    const double one = to_low / motion, other = to_high / motion;
    first_ = std::max(first_, std::min(one, other));
    last_ = std::min(last_, std::max(one, other));
  }
  /// kNever if they do not overlap.
  double first() const { return first_ <= last_ ? first_ : kNever; }

  static constexpr double kNever = std::numeric_limits<double>::infinity();

 private:
  double first_ = 0.0, last_ = 1.0;
};

/// The fractions between which a moving box is near a tree. Single precision is too coarse for the rest of
/// the motion.
struct NearPart {
  double first = 0.0, last = 1.0;
};

/// None if the spheres around tree and box never meet, or if a number is not finite.
inline std::optional<NearPart> nearPart(const Tree& tree, const MovingBox& box) {
  const Vec3 way = tree.origin() - box.start.center;
  const double squared_speed = box.motion.squaredNorm();
  const double closest = squared_speed > 0.0 ? way.dot(box.motion) / squared_speed : 0.0;
  const double reach = (tree.radius() + box.start.half_extents.norm()) * (1.0 + 2.0 * box.rim) +
                       4.0 * kDoubleRounding * (way.norm() + box.start.center.norm());
  const double squared_half_chord = reach * reach - (way - closest * box.motion).squaredNorm();
  if (!(squared_half_chord >= 0.0)) return std::nullopt;
  if (squared_speed == 0.0) return NearPart();
  const double half_part = std::sqrt(squared_half_chord / squared_speed) * (1.0 + kSingleRounding);
  const NearPart part{std::max(0.0, closest - half_part), std::min(1.0, closest + half_part)};
  if (!(part.first <= part.last)) return std::nullopt;
  return part;
}

/// A lower bound of the fraction at which the box first meets a triangle that MotionCull lets through. Tests
/// the triangle's normal, and the axes perpendicular to the motion and an edge.
inline double firstMeeting(const Triangle& triangle, const MovingBox& box, double slack) {
  const double reach = slack + box.rim * boundsOf(triangle).halfExtents().norm();
  OverlapInterval overlap;
  const auto narrow = [&](const Vec3& axis) {
    const double a = axis.dot(triangle[0] - box.start.center), b = axis.dot(triangle[1] - box.start.center),
                 c = axis.dot(triangle[2] - box.start.center);
    const double radius =
        (box.start.axes.transpose() * axis).cwiseAbs().dot(box.start.half_extents) + reach * axis.norm();
    overlap.narrow(std::min({a, b, c}), std::max({a, b, c}), axis.dot(box.motion), radius);
  };
  narrow(scaledNormal(triangle));
  for (int edge = 0; edge < 3; ++edge) {
    narrow((triangle[std::size_t(edge + 1) % 3] - triangle[std::size_t(edge)]).cross(box.motion));
  }
  return overlap.first();
}

}  // namespace octoblisk::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace octoblisk::detail::HWY_NAMESPACE {

constexpr float kSlowest = 1e-30f;  // the least speed to divide by

/// For each of eight boxes, a lower bound of the fraction at which the moving box first overlaps it along all
/// six face axes; above kFarthest if it never does.
class FirstMeetings {
 public:
  /// `slack`: the distance by which rounding may separate boxes that overlap.
  FirstMeetings(const Vec3& motion, double rim, float slack) : rim_(static_cast<float>(rim)), slack_(slack) {
    for (int i = 0; i < 3; ++i) motion_[i] = static_cast<float>(motion[i]);
  }

  Float8 operator()(const Box8& boxes, const BoxF& box) const {
    const Vec8 between = centersOf(boxes) - Vec8::all(box.center), motion = Vec8::all(motion_);
    const Float8 reach = Float8(slack_) + Float8(2.0f * rim_) * (Float8::load(boxes.half_extents[0]) +
                                                                 Float8::load(boxes.half_extents[1]) +
                                                                 Float8::load(boxes.half_extents[2]));
    Float8 first(0.0f), last(1.0f);
    forEachFaceAxis(boxes, box, [&](const Vec8& axis, const Float8& radius) HWY_ATTR {
      // The way to the boxes along the axis. The divisor is at least the slowest speed.
      const Float8 way = dot(axis, between), speed = dot(axis, motion), near = radius + reach;
      const Float8 forward = select(speed, Float8(0.0f), Float8(0.0f) - way, way);
      const Float8 divisor = max(abs(speed), Float8(kSlowest));
      first = max(first, (forward - near) / divisor);
      last = min(last, (forward + near) / divisor);
    });
    return select(last, first, Float8(kMissed), first);
  }

 private:
  static constexpr float kMissed = 1e30f;  // above kFarthest
  float motion_[3];
  float rim_, slack_;
};

/// Tests the moving box against the eight triangles of a leaf, along the axes of the moving box.
class MotionCull {
 public:
  MotionCull(const BoxF& start, const Vec3& motion, double rim, float slack)
      : start_(start),
        speeds_(start.axes.transpose() * motion.cast<float>()),
        rim_(static_cast<float>(rim)),
        slack_(slack) {}

  /// A bit for each triangle that the box may meet up to the fraction `last`. The corners are in rows
  /// (leaf_vertices.h) in the frame of the leaf's box.
  HWY_INLINE unsigned near(const BoxF& leaf, const float* rows, std::uint32_t count, double last) const {
    const Eigen::Matrix3f axes = leaf.axes.transpose() * start_.axes;
    const Eigen::Vector3f center = leaf.axes.transpose() * (start_.center - leaf.center);
    const Vec8 corners[] = {Vec8::load(rows, count), Vec8::load(rows + 3 * count, count),
                            Vec8::load(rows + 6 * count, count)};
    const float reach = slack_ + 2.0f * rim_ * leaf.half_extents.sum();
    Float8 first_meeting(0.0f), last_meeting(static_cast<float>(last));
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3f forward = std::copysign(1.0f, speeds_[i]) * axes.col(i);
      const Vec8 axis = Vec8::all(forward);
      const Float8 a = dot(axis, corners[0]), b = dot(axis, corners[1]), c = dot(axis, corners[2]);
      const float along = forward.dot(center), radius = start_.half_extents[i] + reach;
      const Float8 reciprocal(1.0f / std::max(std::abs(speeds_[i]), kSlowest));
      first_meeting = max(first_meeting, (min(a, min(b, c)) - Float8(along + radius)) * reciprocal);
      last_meeting = min(last_meeting, (max(a, max(b, c)) - Float8(along - radius)) * reciprocal);
    }
    return ((1u << count) - 1u) & ~less(last_meeting, first_meeting);
  }

 private:
  const BoxF& start_;
  Eigen::Vector3f speeds_;  // along the axes of the moving box
  float rim_, slack_;
};

void trianglesAlong(const Tree& tree, const MovingBox& box, const NearPart& near, double last_fraction,
                    AlongVisitor visit) {
  const Obb start{box.start.center + near.first * box.motion, box.start.axes, box.start.half_extents};
  const double share = near.last - near.first;
  LocalBox local(tree, start);
  local.size += share * box.motion.norm();
  const auto slack = static_cast<float>(kSingleRounding * local.size);
  const double slack_of_doubles =
      4.0 * kDoubleRounding * (box.start.center.norm() + box.motion.norm() + local.size);
  double wanted = std::min(last_fraction, 1.0);
  const auto limit = [&] {  // fraction of the near part
    return share > 0.0 ? static_cast<float>((wanted - near.first) / share + kSingleRounding) : 1.0f;
  };
  const MotionCull cull(local.box, share * box.motion, box.rim,
                        4.0f * slack + static_cast<float>(local.doubles));
  walkBox(tree, local, FirstMeetings(share * box.motion, box.rim, slack), limit, [&](Slot leaf) {
    return forEachNearInLeaf(tree, leaf, cull, double(limit()), [&](std::uint32_t triangle) {
      const double first = firstMeeting(tree.mesh().triangle(triangle), box, slack_of_doubles);
      if (first <= wanted) wanted = std::min(wanted, visit(triangle, first));
      return wanted < 0.0;
    });
  });
}

}  // namespace octoblisk::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace octoblisk::detail {

MovingBox movingPoint(const Vec3& start, const Vec3& motion, double tolerance) {
  const double length = motion.norm();
  const Mat3 axes = length > 0.0 ? frameAlong(motion / length) : Mat3::Identity();
  return {{start, axes, Vec3::Constant(tolerance)}, motion};
}

HWY_EXPORT(trianglesAlong);

void forEachTriangleAlong(const ClusteredOctree& tree, const MovingBox& box, double last_fraction,
                          AlongVisitor visit) {
  if (!(last_fraction >= 0.0)) return;
  const std::optional<NearPart> near = nearPart(treeOf(tree), box);
  if (near) HWY_DYNAMIC_DISPATCH(trianglesAlong)(treeOf(tree), box, *near, last_fraction, visit);
}

}  // namespace octoblisk::detail
#endif
