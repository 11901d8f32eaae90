// The way of a body from one pose to another, and how far any of its points gets on it.
#pragma once

#include <array>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

class Convex;

/// A box, grown by a distance, and a ball. Each contains a body, for bounds on its motion. Functions that
/// take a Hold accept a tree or a convex body; a Hold keeps no reference to it. The bounds hold even if
/// rotations are orthonormal to single precision only.
class Hold {
 public:
  Hold(const ClusteredOctree& tree);
  Hold(const Convex& convex);

  /// No point of the body, so turned, is farther than this from the line along `axis`, of unit length,
  /// through the body's `center`.
  double distanceFromAxis(const Mat3& rotation, const Vec3& center, const Vec3& axis) const;

  /// No point of the body is farther than this from a point in its frame.
  double distanceFromPoint(const Vec3& point) const;

  /// No point of the body is farther than this from itself between the two poses.
  double displacement(const Pose& from, const Pose& to) const;

  /// The lengths that set the rounding of what is measured from the body, but for those of poses.
  double size() const { return center_.norm() + radius_; }

 private:
  std::array<Vec3, 8> corners_;  // of the box
  double beyond_ = 0.0;          // how far the body reaches beyond the box at most
  Vec3 center_;                  // of the ball
  double radius_;
};

/// A motion of B in A's frame, at constant speeds over fractions 0 … 1: one point of B, the centre, goes
/// straight, while B turns about an axis of fixed direction through it. A centre on the axis of a screw gives
/// that screw.
class Motion {
 public:
  /// From one pose to another by the shorter turn; of half a turn, by either way. `center_in_b` is the point
  /// of B that goes straight.
  Motion(const Pose& from, const Pose& to, const Vec3& center_in_b = Vec3::Zero());

  /// A turn about the axis through `center_in_a` along `turn`, whose length is the angle in radians, of any
  /// number of revolutions; the axis itself is shifted by `advance` meanwhile.
  static Motion about(const Pose& from, const Vec3& center_in_a, const Vec3& turn,
                      const Vec3& advance = Vec3::Zero());

  /// The pose at a fraction of the way: at 0 the first pose itself, at 1 the last to rounding.
  Pose at(double fraction) const;

  /// The motion of a part of B. The pose of the part in B must be orthonormal to double precision.
  Motion ofPart(const Pose& part_in_b) const;

  /// A length in mesh units that bounds the way of each point of B, along its path, over the whole motion;
  /// over a part of it, the same part of this. |v| + |ω| r for the centre's way v and the greatest
  /// distance r from the axis, where the way along the axis and that across are at right angles.
  double lengthBound(const Hold& b) const;

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

/// A length in mesh units for two bodies that move at once: over a part of the motions, the distance of a
/// point of A and one of B, and so that of the bodies, changes by no more than the same part of this. What
/// the two motions have in common does not count, as long as one frame can follow it. The least of three
/// bounds on the speed of the two points to each other, for centres' ways v, turns ω, greatest distances r
/// from the axes, R from the centres and the arm c from B's centre to A's:
/// - in a frame that keeps its axes and goes along with A's centre: |ω_A| r_A + the lengthBound of B's way
///   less A's, and the same with A and B changed;
/// - in A's own frame: |v_B − v_A + ω_A × c| + |ω_B − ω_A| R_B, with c at the start or the end, whichever
///   gives more, as it changes linearly;
/// - in B's own frame, likewise.
double relativeLengthBound(const Hold& a, const Motion& a_in_world, const Hold& b, const Motion& b_in_world);

}  // namespace octoblisk
