// Bounds on the distances and displacements of a body's points.
#pragma once

#include <array>

#include "octoblisk/clustered_octree.h"

namespace octoblisk {

class Convex;

/// Two bounding volumes of a body, a box grown by a distance and a ball. They bound the motion of the body's
/// points. A tree or a convex body converts to a BodyBounds, which keeps no reference to it. A BodyBounds
/// can also be made from a box. The bounds hold even if rotations are orthonormal to single precision only.
class BodyBounds {
 public:
  BodyBounds(const ClusteredOctree& tree);
  BodyBounds(const Convex& convex);
  explicit BodyBounds(const Aabb& box);

  /// The greatest distance of a point of the rotated body from the line through the body's `center` along
  /// `axis`, of unit length; never too small.
  double distanceFromAxis(const Mat3& rotation, const Vec3& center, const Vec3& axis) const;

  /// The greatest distance of a point of the body from a point in its frame; never too small.
  double distanceFromPoint(const Vec3& point) const;

  /// The greatest displacement of a point of the body between the two poses; never too small.
  double displacement(const Pose& from, const Pose& to) const;

  /// The scale of the rounding errors of distances from the body, without those of its pose.
  double size() const { return center_.norm() + radius_; }

 private:
  std::array<Vec3, 8> corners_;  // of the box
  double beyond_ = 0.0;          // the most by which the body exceeds the box
  Vec3 center_;                  // of the ball
  double radius_;
};

}  // namespace octoblisk
