// A triangle and the core of a sphere, which is a point, or of a capsule, which is a segment: closed forms,
// for triangles that are wide enough to have a normal.
#pragma once

#include "geometry/marginless_contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Where the foot of the point is inside the triangle, the normal is the triangle's own, on whichever side
/// the point is; for a point in the triangle, away from the side that it faces.
MarginlessContact contactOfPoint(const Triangle& triangle, const Vec3& point);

/// A segment that goes through the triangle is parted from it along the triangle's normal, or across one of
/// its edges, whichever is shorter.
MarginlessContact contactOfSegment(const Triangle& triangle, const Vec3& from, const Vec3& to);

}  // namespace octoblisk::detail
