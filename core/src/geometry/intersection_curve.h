// The curve in which two surfaces meet.
#pragma once

#include <optional>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The curve in which the surfaces of two bodies A and B meet, from the triangle pairs that meet.
class IntersectionCurve {
 public:
  struct Segment {
    Vec3 from, to;
  };

  void clear() { segments_.clear(); }

  /// Adds the segment in which two triangles meet; nothing if they are in one plane or only touch.
  void add(const Triangle& a, const Triangle& b);

  /// The direction in which moving A makes the volume of the overlap shrink fastest, a unit vector. It is
  /// against the area vector of A's surface inside B, which depends on the boundary of that surface only.
  /// None if the curve is not closed, or if its parts nearly cancel.
  std::optional<Vec3> wayOut() const;

  /// The mean of the curve's points, if there is a way out.
  Vec3 middle() const;

  /// How far the curve extends along a unit vector, if there is a way out.
  double extentAlong(const Vec3& direction) const;

 private:
  std::vector<Segment> segments_;
};

}  // namespace octoblisk::detail
