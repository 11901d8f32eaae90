// Normals that make a faceted surface look smooth where it is meant to be, and sharp at its creases.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The unit normals at the three corners of a triangle.
using CornerNormals = std::array<Eigen::Vector3f, 3>;

/// For each corner of each triangle the mean of the normals of the triangles around that point, weighted by
/// area, but only of those that turn by less than `crease_angle` (radians) from the triangle's own.
/// Vertices at the same place count as one. A degenerate triangle has zero normals.
std::vector<CornerNormals> cornerNormals(std::span<const Vec3> vertices,
                                         std::span<const TriangleMesh::Indices> triangles,
                                         double crease_angle);

}  // namespace octoblisk::demos
