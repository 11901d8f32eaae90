// A mesh whose vertices at equal coordinates are one.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// A point's distance from the Z axis.
inline double radiusOf(const Vec3& point) { return std::hypot(point.x(), point.y()); }

/// A mesh with the vertices that its triangles share, and the radii that they reach from and to.
struct WeldedSurface {
  const TriangleMesh& mesh;
  std::vector<TriangleMesh::Indices> corners;  ///< of each triangle; the first of the vertices at that place
  std::vector<double> low, high;               ///< least and greatest radius, one a triangle
  std::vector<std::uint32_t> outermost;        ///< triangles by `low`, greatest first

  /// The mesh must outlive the surface.
  explicit WeldedSurface(const TriangleMesh& source);

  /// The triangles beside each triangle, over its three edges. Where more than two share an edge, they are
  /// all beside each other in a row.
  std::vector<std::vector<std::uint32_t>> neighbours() const;
};

}  // namespace octoblisk::demos
