// The feature of a triangle on which a contact lies: the inside, an edge or a corner.
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The feature of a point inside: all three corners.
inline constexpr unsigned kFace = 0b111u;

/// The corners of the edge on which a point of a triangle lies, or the one corner: bit v for corner v. kFace
/// for a point inside. The normal is scaledNormal(triangle). A point is on an edge if it is nearer than
/// this fraction of the triangle's height.
inline unsigned featureOf(const Triangle& triangle, const Vec3& normal, const Vec3& point,
                          double on_edge = 1e-6) {
  unsigned feature = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 &from = triangle[(v + 1) % 3], &to = triangle[(v + 2) % 3];
    const double weight = normal.dot((to - from).cross(point - from));
    if (weight > on_edge * normal.squaredNorm()) feature |= 1u << v;
  }
  return feature;
}

/// Whether a point is over or under the triangle or its boundary. The normal is along scaledNormal(triangle).
inline bool isOver(const Triangle& triangle, const Vec3& normal, const Vec3& point) {
  for (std::size_t v = 0; v < 3; ++v) {
    if (normal.dot((triangle[(v + 1) % 3] - triangle[v]).cross(point - triangle[v])) < 0.0) return false;
  }
  return true;
}

/// The ends of the edge of a feature, which must not be the whole triangle. For a corner, both ends are that
/// corner.
inline std::array<std::size_t, 2> endsOf(unsigned feature) {
  return {static_cast<std::size_t>(std::countr_zero(feature)),
          static_cast<std::size_t>(31 - std::countl_zero(feature))};
}

/// The least cosine of the angle between two directions that count as the same, and the greatest sine.
inline constexpr double kParallelCosine = 1.0 - 1e-6, kParallelSine = 1.5e-3;
static_assert(kParallelCosine * kParallelCosine + kParallelSine * kParallelSine > 1.0);

/// Whether a direction is perpendicular to the triangle's face, up to sign; never if the triangle has no
/// area. The normal is scaledNormal of the triangle; the direction is a unit vector.
inline bool isPerpendicular(const Vec3& normal, const Vec3& direction) {
  const double along = normal.dot(direction);
  return along * along > kParallelCosine * kParallelCosine * normal.squaredNorm();
}

/// The sine of the angle by which a direction from an edge leans over a triangle that has this edge; negative
/// if it leans away. From a corner (both ends equal): the greater cosine of its angles to the two edges
/// there. -1 if the triangle has no area there. The direction is a unit vector.
inline double sineOfLean(const Triangle& triangle, const Vec3& from, const Vec3& to, const Vec3& direction) {
  const Vec3 edge = to - from;
  const double squared = edge.squaredNorm();
  double greatest = -1.0;
  for (const Vec3& corner : triangle) {
    Vec3 inward = corner - from;
    if (squared > 0.0) inward -= edge * (edge.dot(inward) / squared);
    const double length = inward.norm();
    if (length > 0.0) greatest = std::max(greatest, direction.dot(inward) / length);
  }
  return greatest;
}

}  // namespace octoblisk::detail
