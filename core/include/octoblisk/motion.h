// The motion of a body from one pose to another, and bounds on the motion of its points.
#pragma once

#include "octoblisk/body_bounds.h"

namespace octoblisk {

/// A motion of B in A's frame at constant speeds, over fractions 0 … 1. One point of B, the centre, moves
/// along a straight line while B rotates about an axis of fixed direction through it. If the centre is on the
/// axis of a screw, the motion is that screw.
class Motion {
 public:
  /// From one pose to another by the smaller rotation; at half a turn, by either rotation. `center_in_b` is
  /// the point of B that moves along a straight line.
  Motion(const Pose& from, const Pose& to, const Vec3& center_in_b = Vec3::Zero());

  /// A rotation about the axis through `center_in_a` along `turn`, whose length is the angle in radians, with
  /// any number of revolutions. Meanwhile the axis shifts by `advance`.
  static Motion about(const Pose& from, const Vec3& center_in_a, const Vec3& turn,
                      const Vec3& advance = Vec3::Zero());

  /// The pose at a fraction: exactly the first pose at 0, the last pose up to rounding at 1.
  Pose at(double fraction) const;

  /// The motion of a part of B. The pose of the part in B must be orthonormal to double precision.
  Motion ofPart(const Pose& part_in_b) const;

  /// Bounds the length of the path of any point of B, in mesh units. A fraction of the motion has the same
  /// fraction of the bound. The bound is sqrt(p² + (q + |ω| r)²). p and q are the components of the centre's
  /// displacement along and across the axis. r is the greatest distance of B from the axis.
  double lengthBound(const BodyBounds& b) const;

  const Pose& from() const { return from_; }
  const Vec3& centerInB() const { return center_in_b_; }
  const Vec3& advance() const { return advance_; }  ///< of the centre, in A's frame
  const Vec3& axis() const { return axis_; }        ///< unit, in A's frame
  double angle() const { return angle_; }           ///< about the axis, radians, >= 0

 private:
  Motion() = default;

  Pose from_;
  Vec3 center_in_b_ = Vec3::Zero();
  Vec3 advance_ = Vec3::Zero();
  Vec3 axis_ = Vec3::UnitX();
  double angle_ = 0.0;
};

/// A bound for two bodies that move at the same time, in mesh units. Over a fraction of the motions, the
/// distance between any point of A and any point of B changes by at most the same fraction of the bound, and
/// so does the distance between the bodies. A motion that both bodies share adds nothing if one of the frames
/// below follows it.
///
/// The bound is the least of four, one for each frame. v_A and v_B are the displacements of the centres, ω_A
/// and ω_B the rotation vectors. r is the greatest distance of a body's points from its axis, R that from its
/// centre. c is the vector from B's centre to A's centre.
/// - In a frame that moves with A's centre and does not rotate: |ω_A| r_A plus B's lengthBound with the
///   displacement v_B − v_A.
/// - In a frame that moves with B's centre: the same with A and B exchanged.
/// - In A's own frame: |v_B − v_A + ω_A × c| + |ω_B − ω_A| R_B. c changes linearly, so the first term is
///   greatest at the start or at the end.
/// - In B's own frame: the same with A and B exchanged.
double relativeLengthBound(const BodyBounds& a, const Motion& a_in_world, const BodyBounds& b,
                           const Motion& b_in_world);

}  // namespace octoblisk
