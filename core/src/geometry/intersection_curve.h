// The curve in which two surfaces meet.
#pragma once

#include <optional>
#include <span>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A part of the curve. A's surface inside B is to its left, seen from outside A.
struct CurveSegment {
  Vec3 from, to;
  Vec3 normal_a, normal_b;  ///< outward, of any length
};

/// The curve in which the surfaces of two bodies A and B meet: the segments of all triangle pairs that meet,
/// in any order.
using IntersectionCurve = std::span<const CurveSegment>;

/// The segment in which two triangles meet; none if they are in one plane or only touch.
std::optional<CurveSegment> meetingSegment(const Triangle& a, const Triangle& b);

/// The direction in which moving A makes the volume of the overlap shrink fastest, a unit vector. It is
/// against the area vector of A's surface inside B, which depends on the boundary of that surface only.
/// None if the curve is not closed, or if its parts nearly cancel.
std::optional<Vec3> wayOut(IntersectionCurve curve);

/// The mean of the points of a curve that has a way out.
Vec3 middleOf(IntersectionCurve curve);

/// How far the curve extends along the way out, a unit vector.
double extentAlong(const Vec3& way_out, IntersectionCurve curve);

/// How deep the bodies overlap on the line through the curve's middle along the way out, a unit vector. Takes
/// the overlap for the convex body behind all faces that meet in the curve. Infinite if these faces do not
/// bound it on one side; negative if the line misses it.
double depthAlong(const Vec3& way_out, IntersectionCurve curve);

}  // namespace octoblisk::detail
