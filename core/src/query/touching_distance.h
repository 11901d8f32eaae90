// The distance below which parts of a mesh touch, and triangles have no area.
#pragma once

#include "geometry/thin_triangle.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Parts of a mesh that are closer to each other than this touch. It is the rounding of points and planes
/// near the mesh: a few hundred units in the last place of its coordinates.
inline double touchingDistance(const TriangleMesh& mesh) {
  return 1e-13 * mesh.bounds().farthestFromOrigin();
}

/// Whether a triangle is higher than the tolerance.
inline bool hasArea(const Triangle& triangle, double tolerance) {
  return scaledNormal(triangle).squaredNorm() > tolerance * tolerance * squaredLongestEdge(triangle);
}

}  // namespace octoblisk::detail
