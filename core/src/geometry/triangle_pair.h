// Two triangles: whether they meet, how far apart they are, how deep one is in the other.
#pragma once

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Whether two closed triangles share a point. The verdict equals exact arithmetic on the given doubles.
/// Touching counts. A degenerate triangle counts as a segment or a point.
bool intersects(const Triangle& a, const Triangle& b);

/// The same for a triangle of each of two meshes.
inline bool intersects(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, TrianglePair pair) {
  return intersects(a.triangle(pair.a), b_in_a * b.triangle(pair.b));
}

/// The closest points of two triangles that do not meet. The normal points from b to a. The distance is above
/// 0. It is accurate to about 1e-14 of the triangles' size, between slivers to 1e-10. Lengths below 1e-70
/// count as 0.
Contact closestPoints(const Triangle& a, const Triangle& b);

/// The contact of two triangles that meet. The distance is minus the length of the shortest translation along
/// the outward normal of one of the two faces that separates them. The points are the ends of this
/// translation: one is the deepest point of one triangle below the other, and one lies on that other
/// triangle. A face that is degenerate, or thinner than 1e-12 of its length, is not used. If neither face can
/// be used, the distance is 0.
Contact meetingContact(const Triangle& a, const Triangle& b);

/// meetingContact or closestPoints. The distance is above 0 exactly if the triangles do not meet.
Contact contactOf(const Triangle& a, const Triangle& b);

}  // namespace octoblisk::detail
