#include "octoblisk/motion.h"

#include <algorithm>
#include <cmath>

#include "base/trigonometry.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The turn about a unit axis (O. Rodrigues, 1840).
Mat3 rotationAbout(const Vec3& axis, double angle) {
  const auto [sine, cosine] = sineCosine(angle);
  const Vec3 sines = sine * axis, rest = (1.0 - cosine) * axis;
  Mat3 rotation = rest * axis.transpose();
  rotation.diagonal().array() += cosine;
  rotation(0, 1) -= sines.z(), rotation(1, 0) += sines.z();
  rotation(0, 2) += sines.y(), rotation(2, 0) -= sines.y();
  rotation(1, 2) -= sines.x(), rotation(2, 1) += sines.x();
  return rotation;
}

/// Bounds the path length of a body's points if it rotates as in the motion and its centre moves by the
/// advance: |advance along the axis, advance across the axis + angle · radius|.
double lengthOfWay(const BodyBounds& bounds, const Motion& motion, const Vec3& advance) {
  const double radius = bounds.distanceFromAxis(motion.from().rotation, motion.centerInB(), motion.axis());
  const double along = advance.dot(motion.axis()), across = (advance - along * motion.axis()).norm();
  const double round = across + motion.angle() * radius;
  const double longer = std::max(std::abs(along), round), shorter = std::min(std::abs(along), round);
  if (longer == 0.0) return 0.0;
  return longer * std::sqrt(1.0 + (shorter / longer) * (shorter / longer));
}

}  // namespace

Motion::Motion(const Pose& from, const Pose& to, const Vec3& center_in_b)
    : from_(from), center_in_b_(center_in_b), advance_(to * center_in_b - from * center_in_b) {
  const Mat3 turn = to.rotation * from.rotation.transpose();
  const Eigen::Quaterniond q(turn);
  const Vec3 along_axis(q.x(), q.y(), q.z());  // as long as the sine of half the angle
  if (along_axis.isZero(0.0)) return;
  axis_ = (q.w() < 0.0 ? -1.0 : 1.0) * along_axis.stableNormalized();
  angle_ = 2.0 * angleOf(along_axis.norm(), std::abs(q.w()));
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
  const Mat3 rotation = rotationAbout(axis_, fraction * angle_) * from_.rotation;
  const Vec3 swing = from_.rotation * center_in_b_ - rotation * center_in_b_;
  return {rotation, from_.translation + (fraction * advance_ + swing)};
}

Motion Motion::ofPart(const Pose& part_in_b) const {
  Motion motion = *this;
  motion.from_ = from_ * part_in_b;
  motion.center_in_b_ = part_in_b.inverse() * center_in_b_;
  return motion;
}

double Motion::lengthBound(const BodyBounds& b) const { return lengthOfWay(b, *this, advance_); }

double relativeLengthBound(const BodyBounds& a, const Motion& a_in_world, const BodyBounds& b,
                           const Motion& b_in_world) {
  const Vec3 way = b_in_world.advance() - a_in_world.advance();  // of B's centre from A's
  const double with_center_a = lengthOfWay(a, a_in_world, Vec3::Zero()) + lengthOfWay(b, b_in_world, way);
  const double with_center_b = lengthOfWay(b, b_in_world, Vec3::Zero()) + lengthOfWay(a, a_in_world, -way);
  const Vec3 turn_a = a_in_world.angle() * a_in_world.axis(), turn_b = b_in_world.angle() * b_in_world.axis();
  const Vec3 arm = a_in_world.from() * a_in_world.centerInB() - b_in_world.from() * b_in_world.centerInB();
  const auto inFrameThatTurns = [&](const Vec3& turn, double distance_from_center) {
    const double at_start = (way + turn.cross(arm)).norm(), at_end = (way + turn.cross(arm - way)).norm();
    return std::max(at_start, at_end) + (turn_b - turn_a).norm() * distance_from_center;
  };
  const double in_a = inFrameThatTurns(turn_a, b.distanceFromPoint(b_in_world.centerInB()));
  const double in_b = inFrameThatTurns(turn_b, a.distanceFromPoint(a_in_world.centerInB()));
  return std::min({with_center_a, with_center_b, in_a, in_b});
}

}  // namespace octoblisk
