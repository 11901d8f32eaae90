// Which points and solids are inside which others.
//
// A point is inside a mesh if the winding number of the mesh, rounded, is not 0. The winding number counts
// how often the mesh encloses the point: 1 inside a surface that faces outward, -1 inside one that faces
// inward, 0 outside and in hollows, 2 where two parts overlap. Copies of a triangle count once. Where a mesh
// has open edges, the winding number is no integer (A. Jacobson, L. Kavan, O. Sorkine-Hornung, Robust
// inside-outside segmentation using generalized winding numbers, ACM TOG 32 (4), 2013).
#pragma once

#include "octoblisk/closest_point.h"
#include "octoblisk/surface.h"

namespace octoblisk {

enum class PointLocation { outside, inside, on_surface };

/// Where a point in A's frame is. The surface's vertices are posed in double precision. If no edge is open,
/// the verdict equals exact arithmetic. Otherwise the winding number has an error before it is rounded: 1e-6
/// or less, at points that are farther from open edges than 1e-6 of the mesh's size. Allocates nothing.
PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a = {});

/// The same, but faster if the surface is whole. `nearest` is the surface's point closest to `point`. Where
/// the surface faces outward, the pseudonormal of the nearest point decides (J. A. Bærentzen, H. Aanæs,
/// Signed distance computation using the angle weighted pseudonormal, IEEE TVCG 11 (3), 2005). Within
/// rounding of the surface, the answer may then differ from the exact one.
PointLocation locate(const Surface& surface, const Vec3& point, const ClosestPoint& nearest);

/// The winding number of a point that is not on the surface. Visits all open edges; `locate` only as many as
/// it needs.
double windingNumber(const Surface& surface, const Vec3& point);

enum class Containment {
  apart,
  touching,    ///< the surfaces share a point
  a_inside_b,  ///< A does not touch B's surface
  b_inside_a,
  overlapping,  ///< the surfaces do not meet, yet only some of A is in B: A or B has several components
  unknown,      ///< the surfaces do not meet, and one is open
};

/// How two solids lie relative to each other. The verdict equals exact arithmetic on B's vertices posed in
/// double precision, as far as `locate` does. A solid in a hollow of the other is apart from it. Allocates
/// nothing.
Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a);

}  // namespace octoblisk
