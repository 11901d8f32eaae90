// A mesh with merged vertices: those at equal coordinates count as one.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// A point's distance from the Z axis.
inline double radiusOf(const Vec3& point) { return std::hypot(point.x(), point.y()); }

/// For each vertex, the one that stands for all vertices at its place.
std::vector<std::uint32_t> firstAtSamePlace(std::span<const Vec3> vertices);

/// A mesh, the vertices that its triangles share, and the range of radii of each triangle.
struct WeldedSurface {
  const TriangleMesh& mesh;
  std::vector<TriangleMesh::Indices> corners;  ///< per triangle; the first of the vertices at that place
  std::vector<double> low, high;               ///< least and greatest radius, per triangle
  std::vector<std::uint32_t> outermost;        ///< triangles by `low`, greatest first

  /// The mesh must outlive the surface.
  explicit WeldedSurface(const TriangleMesh& source);

  /// The triangles beside each triangle, over its three edges. If more than two share an edge, they form a
  /// row of neighbours.
  std::vector<std::vector<std::uint32_t>> neighbours() const;
};

}  // namespace octoblisk::demos
