#include "octoblisk/motion.h"

#include <algorithm>
#include <cmath>

namespace octoblisk {
namespace {

/// The part of the radius by which a box in single precision may be off.
constexpr double kBoxRounding = 1e-6;

}  // namespace

Motion::Motion(const Pose& from, const Pose& to, const Vec3& center_in_b)
    : from_(from), center_in_b_(center_in_b), advance_(to * center_in_b - from * center_in_b) {
  const Mat3 turn = to.rotation * from.rotation.transpose();
  const Eigen::AngleAxisd shorter(turn);
  axis_ = shorter.axis();
  angle_ = shorter.angle();
}

Motion Motion::about(const Pose& from, const Vec3& center_in_a, const Vec3& turn, const Vec3& advance) {
  Motion motion;
  motion.from_ = from;
  motion.center_in_b_ = from.inverse() * center_in_a;
  motion.advance_ = advance;
  motion.angle_ = turn.norm();
  if (motion.angle_ > 0.0) motion.axis_ = turn.stableNormalized();
  return motion;
}

Pose Motion::at(double fraction) const {
  const Mat3 rotation = Eigen::AngleAxisd(fraction * angle_, axis_).toRotationMatrix() * from_.rotation;
  const Vec3 swing = from_.rotation * center_in_b_ - rotation * center_in_b_;
  return {rotation, from_.translation + (fraction * advance_ + swing)};
}

double Motion::lengthBound(const ClusteredOctree& b) const {
  const double radius = Hold(b).distanceFromAxis(from_.rotation, center_in_b_, axis_);
  const double along = advance_.dot(axis_), across = (advance_ - along * axis_).norm();
  return std::hypot(along, across + angle_ * radius);
}

Hold::Hold(const ClusteredOctree& tree) : center_(tree.origin()), radius_(tree.radius()) {
  const Obb box = tree.box(ClusteredOctree::kRoot);
  for (unsigned corner = 0; corner < corners_.size(); ++corner) {
    const Vec3 side(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    corners_[corner] = box.center + box.axes * side.cwiseProduct(box.half_extents);
  }
}

// Both distances are convex functions of the point, so that none in the box exceeds the corners' largest.

double Hold::distanceFromAxis(const Mat3& rotation, const Vec3& center, const Vec3& axis) const {
  const auto fromAxis = [&](const Vec3& point) { return (rotation * (point - center)).cross(axis).norm(); };
  double of_box = 0.0;
  for (const Vec3& corner : corners_) of_box = std::max(of_box, fromAxis(corner));
  return std::min(of_box, fromAxis(center_) + radius_) + kBoxRounding * radius_;
}

double Hold::displacement(const Pose& from, const Pose& to) const {
  const Mat3 turn = to.rotation - from.rotation;
  const Vec3 shift = to.translation - from.translation;
  const auto displaced = [&](const Vec3& point) { return (turn * point + shift).norm(); };
  const double ball = turn.norm() * radius_;
  double of_box = 0.0;
  for (const Vec3& corner : corners_) of_box = std::max(of_box, displaced(corner));
  return std::min(of_box + kBoxRounding * ball, displaced(center_) + ball);
}

}  // namespace octoblisk
