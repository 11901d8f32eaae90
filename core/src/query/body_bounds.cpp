#include "octoblisk/body_bounds.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "octoblisk/convex.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The error of a box in single precision, as a fraction of its radius.
constexpr double kBoxRounding = 1e-6;

}  // namespace

BodyBounds::BodyBounds(const ClusteredOctree& octree)
    : corners_(treeOf(octree).box(Tree::kRoot).corners()),
      center_(treeOf(octree).origin()),
      radius_(treeOf(octree).radius()) {}

BodyBounds::BodyBounds(const Convex& convex) {
  const Aabb core = convex.coreBounds();
  corners_ = core.corners();
  center_ = core.center();
  beyond_ = convex.radius() + convex.precision() * (core.center().norm() + core.halfExtents().norm());
  radius_ = core.halfExtents().norm();
  if (const std::span<const Vec3> points = convex.points(); !points.empty()) {
    radius_ = 0.0;
    for (const Vec3& point : points) radius_ = std::max(radius_, (point - center_).norm());
  }
  radius_ += beyond_;
}

BodyBounds::BodyBounds(const Aabb& box)
    : corners_(box.corners()), center_(box.center()), radius_(box.halfExtents().norm()) {}

// All distances are convex functions of the point, so the corners of the box have the greatest. Outside the
// box, they grow by at most the distance from the box.

double BodyBounds::distanceFromAxis(const Mat3& rotation, const Vec3& center, const Vec3& axis) const {
  const auto fromAxis = [&](const Vec3& point) { return (rotation * (point - center)).cross(axis).norm(); };
  double of_box = 0.0;
  for (const Vec3& corner : corners_) of_box = std::max(of_box, fromAxis(corner));
  return std::min(of_box + beyond_, fromAxis(center_) + radius_) + kBoxRounding * radius_;
}

double BodyBounds::distanceFromPoint(const Vec3& point) const {
  double of_box = 0.0;
  for (const Vec3& corner : corners_) of_box = std::max(of_box, (corner - point).norm());
  return std::min(of_box + beyond_, (center_ - point).norm() + radius_) + kBoxRounding * radius_;
}

double BodyBounds::displacement(const Pose& from, const Pose& to) const {
  const Mat3 turn = to.rotation - from.rotation;
  const Vec3 shift = to.translation - from.translation;
  const auto squared = [&](const Vec3& point) { return (turn * point + shift).squaredNorm(); };
  double of_box = 0.0;
  // If the pose is NaN, so is every displacement: std::max(NaN, x) returns NaN.
  for (const Vec3& corner : corners_) of_box = std::max(squared(corner), of_box);
  const double turned = turn.norm(), ball = turned * radius_;
  return std::min(std::sqrt(of_box) + kBoxRounding * ball + turned * beyond_,
                  std::sqrt(squared(center_)) + ball);
}

}  // namespace octoblisk
