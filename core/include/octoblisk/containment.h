// Which points and solids are inside which others.
//
// A closed surface bounds a solid. A point is inside it if a half-line from the point crosses the surface an
// odd number of times. For a surface that does not meet itself this is the usual inside, whichever way the
// surface faces. In nested shells, every second shell is a hollow. A region where two lobes of one surface
// overlap counts as outside.
#pragma once

#include "octoblisk/surface.h"

namespace octoblisk {

enum class PointLocation {
  outside,
  inside,
  on_surface,
  unknown,  ///< not on the surface, and the surface is open, so it has no inside
};

/// Where a point in A's frame is. The surface's vertices are posed in double precision; the verdict then
/// equals exact arithmetic, even if the half-line runs through edges and vertices. Allocates nothing.
PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a = {});

enum class Containment {
  apart,
  touching,    ///< the surfaces share a point
  a_inside_b,  ///< A does not touch B's surface
  b_inside_a,
  overlapping,  ///< the surfaces do not meet, yet only some of A is in B: A or B has several components
  unknown,      ///< the surfaces do not meet, and one is open
};

/// How two solids lie relative to each other. The verdict equals exact arithmetic on B's vertices posed in
/// double precision. A solid in a hollow of the other is apart from it. Allocates nothing.
Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a);

}  // namespace octoblisk
