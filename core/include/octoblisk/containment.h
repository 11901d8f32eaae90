// What lies inside what: points and solids.
//
// A closed surface bounds a solid: the points from which a half-line crosses it an odd number of times. That
// is what one means of a surface that does not meet itself, whichever way it faces; of shells within each
// other every second one is a hollow, and where two lobes of one surface overlap, that part counts as
// outside.
#pragma once

#include "octoblisk/surface.h"

namespace octoblisk {

enum class PointLocation {
  outside,
  inside,
  on_surface,
  unknown,  ///< not on the surface, and the surface is open: there is no inside
};

/// Where a point of the frame A lies. The surface's vertices are posed in double precision; the verdict then
/// equals exact arithmetic, also where lines of sight run through edges and vertices. Allocates nothing.
PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a = {});

enum class Containment {
  apart,
  touching,    ///< the surfaces share a point
  a_inside_b,  ///< and nowhere touches its surface
  b_inside_a,
  overlapping,  ///< no surfaces meet, yet some but not all of A is in B: solids of several parts or hollows
  unknown,      ///< no surfaces meet, and one is open
};

/// How two solids lie. The verdict equals exact arithmetic on B's vertices posed in double precision; a solid
/// in another's hollow is apart from it. Allocates nothing.
Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a);

}  // namespace octoblisk
