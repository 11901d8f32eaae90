// The curve in which two surfaces meet.
#pragma once

#include <optional>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The curve in which the surfaces of two bodies A and B meet, from the triangle pairs that meet.
class IntersectionCurve {
 public:
  /// Adds the segment in which two triangles meet; nothing if they are in one plane or only touch.
  void add(const Triangle& a, const Triangle& b);

  /// The direction in which moving A makes the volume of the overlap shrink fastest, a unit vector. It is
  /// against the area vector of A's surface inside B, which depends on the boundary of that surface only.
  /// None if the curve is not closed, or if its parts nearly cancel.
  std::optional<Vec3> wayOut() const;

  /// The mean of the curve's points, if there is a way out.
  Vec3 middle() const { return first_ + sum_ / length_; }

 private:
  Vec3 first_ = Vec3::Zero();  // a point of the curve; sums are relative to it
  double length_ = 0.0;
  Vec3 sum_ = Vec3::Zero();   // of the points
  Vec3 area_ = Vec3::Zero();  // twice the area vector
  Vec3 end_ = Vec3::Zero();   // from the beginning of the curve to its end
};

}  // namespace octoblisk::detail
