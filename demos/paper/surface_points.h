// Point clouds of surfaces, similar to those of a scanner or a path planner.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Nearly evenly spread points on the surface: out of ten times as many seeded random ones, spread by area,
/// each next point is the farthest from those chosen before (T. F. Gonzalez, Clustering to minimize the
/// maximum intercluster distance, 1985). The time grows with the square of the count. The points are the
/// same, bit for bit, for the same seed. Throws std::invalid_argument for a count of 0 or a mesh without
/// area.
std::vector<Vec3> evenPoints(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

double surfaceArea(const TriangleMesh& mesh);

/// The triangles with these indices, and only their vertices. Throws std::invalid_argument if there are none.
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

/// The triangles with the given number, and only their vertices. Throws std::invalid_argument if no triangle
/// has it, or if the counts of numbers and triangles differ.
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const int> number_of_triangle, int number);

}  // namespace octoblisk::demos
