// Normals that make a faceted surface look smooth on its surfaces and sharp at its creases.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The unit normals at the three corners of a triangle.
using CornerNormals = std::array<Eigen::Vector3f, 3>;

/// For each corner of each triangle, the area-weighted mean of the normals of the triangles around that
/// point, but only of those that turn by less than `crease_angle` (radians) from the triangle's own normal.
/// Vertices at the same place count as one. A degenerate triangle has zero normals.
std::vector<CornerNormals> cornerNormals(std::span<const Vec3> vertices,
                                         std::span<const TriangleMesh::Indices> triangles,
                                         double crease_angle);

}  // namespace octoblisk::demos
