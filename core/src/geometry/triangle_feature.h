// Where on a triangle a contact is: inside, on an edge, at a corner.
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The corners of the edge that a point of a triangle is on, or the one corner that it is at: bit v for
/// corner v. All three for a point inside. The normal is scaledNormal(triangle).
inline unsigned featureOf(const Triangle& triangle, const Vec3& normal, const Vec3& point) {
  constexpr double kOn = 1e-6;  // of the triangle's size
  unsigned feature = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 &from = triangle[(v + 1) % 3], &to = triangle[(v + 2) % 3];
    const double weight = normal.dot((to - from).cross(point - from));
    if (weight > kOn * normal.squaredNorm()) feature |= 1u << v;
  }
  return feature;
}

/// The ends of the edge of a feature that is not all of the triangle; a corner's are both that corner.
inline std::array<std::size_t, 2> endsOf(unsigned feature) {
  return {static_cast<std::size_t>(std::countr_zero(feature)),
          static_cast<std::size_t>(31 - std::countl_zero(feature))};
}

/// Whether a direction is square to the triangle's own face, either way; never for one without area.
/// The normal is scaledNormal of the triangle.
inline bool isSquare(const Vec3& normal, const Vec3& direction) {
  constexpr double kSameDirection = 1.0 - 1e-6;
  return std::abs(normal.dot(direction)) > kSameDirection * normal.norm();
}

/// Whether a direction from an edge, or a corner (both ends alike), leans over a triangle that has it.
inline bool leansOver(const Triangle& triangle, const Vec3& from, const Vec3& to, const Vec3& direction) {
  constexpr double kLean = 1e-3;
  const Vec3 edge = to - from;
  for (const Vec3& corner : triangle) {
    Vec3 inward = corner - from;
    if (edge.squaredNorm() > 0.0) inward -= edge * (edge.dot(inward) / edge.squaredNorm());
    if (direction.dot(inward) > kLean * inward.norm()) return true;
  }
  return false;
}

}  // namespace octoblisk::detail
