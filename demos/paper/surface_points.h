// Point clouds of surfaces, as a scanner or a path planner would give them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Points on the surface, about evenly spread: of ten times as many seeded random ones, spread by area, each
/// next is the farthest from those taken before (T. F. Gonzalez, Clustering to minimize the maximum
/// intercluster distance, 1985). Takes time by the square of the count. The same bits for the same seed.
/// Throws std::invalid_argument for a count of 0 or a mesh without area.
std::vector<Vec3> evenPoints(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

double surfaceArea(const TriangleMesh& mesh);

/// These triangles, by their indices, with their vertices alone.
/// Throws std::invalid_argument where there are none.
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles);

/// The triangles with the given number, with their vertices alone.
/// Throws std::invalid_argument where no triangle has it, or there are not as many numbers as triangles.
TriangleMesh partOf(const TriangleMesh& mesh, std::span<const int> number_of_triangle, int number);

}  // namespace octoblisk::demos
