// Two triangles: whether they meet, how far apart they are, how deep one is in the other.
#pragma once

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Whether two closed triangles share a point. The verdict equals exact arithmetic on the given doubles;
/// touching counts, and degenerate triangles are the segments or points that they are.
bool intersects(const Triangle& a, const Triangle& b);

/// The closest points of two triangles that do not meet. The normal points from b to a; the distance is above
/// 0, and right to about 1e-14 of the triangles' size. Lengths below 1e-70 are taken as 0.
Contact closestPoints(const Triangle& a, const Triangle& b);

/// The contact of two triangles that meet. Its distance is minus the length of the shortest translation along
/// the outward normal of one of the two faces that parts them, and the points are the ends of it: one is the
/// deepest point of one triangle over the other, one lies on that other. A face that is degenerate, or
/// thinner than 1e-12 of its length, is not taken for this; where both are, the distance is 0.
Contact meetingContact(const Triangle& a, const Triangle& b);

/// Whichever of the two it is: the distance is above 0 exactly where the triangles do not meet.
Contact contactOf(const Triangle& a, const Triangle& b);

}  // namespace octoblisk::detail
