// The closest point of a triangle, and whether it is the foot of the perpendicular.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct ClosestOnTriangle {
  Vec3 point;
  bool is_foot;  ///< a perpendicular to the triangle's plane leads to it; false if the triangle is thin
};

/// The normal is scaledNormal(triangle).
ClosestOnTriangle closestPointOf(const Triangle& triangle, const Vec3& normal, const Vec3& point);

}  // namespace octoblisk::detail
