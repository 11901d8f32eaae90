// Contacts of a triangle with the core of a sphere (a point) or of a capsule (a segment) in closed form.
#pragma once

#include "geometry/core_contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// If the foot of the point is inside the triangle, the normal is the triangle's own, whichever side the
/// point is on. For a point in the triangle, it points away from the side that the triangle faces.
CoreContact contactOfPoint(const Triangle& triangle, const Vec3& point);

/// A segment that goes through the triangle is separated from it along the triangle's normal or across one of
/// its edges, whichever is shorter. The triangle must not be thin.
CoreContact contactOfSegment(const Triangle& triangle, const Vec3& from, const Vec3& to);

}  // namespace octoblisk::detail
