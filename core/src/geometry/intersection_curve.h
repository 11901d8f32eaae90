// The curve in which two surfaces meet.
#pragma once

#include <optional>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The curve in which the surfaces of two bodies A and B meet, from the triangle pairs that meet.
class IntersectionCurve {
 public:
  void clear() { segments_.clear(); }

  /// Adds the segment in which two triangles meet; nothing if they are in one plane or only touch.
  void add(const Triangle& a, const Triangle& b);

  /// The direction in which moving A makes the volume of the overlap shrink fastest, a unit vector. It is
  /// against the area vector of A's surface inside B, which depends on the boundary of that surface only.
  /// None if the curve is not closed, or if its parts nearly cancel.
  std::optional<Vec3> wayOut() const;

  bool isEmpty() const { return segments_.empty(); }

  /// The mean of the points of a curve that is not empty.
  Vec3 middle() const;

  /// How far a curve that is not empty extends along a unit vector.
  double extentAlong(const Vec3& direction) const;

 private:
  struct Segment {
    Vec3 from, to;
  };

  /// The part of a plane that is in a triangle; none if the triangle is on one side of the plane or in it.
  static std::optional<Segment> cutOf(const Triangle& triangle, const Vec3& on_plane, const Vec3& normal);
  /// The segment in which two triangles meet. A's surface inside B is to its left, seen from outside A.
  static std::optional<Segment> meetingSegment(const Triangle& a, const Triangle& b);

  std::vector<Segment> segments_;
};

}  // namespace octoblisk::detail
