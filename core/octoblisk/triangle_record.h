// A triangle while a tree is built: single precision, relative to the tree's origin.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

struct alignas(64) TriangleRecord {
  std::array<Eigen::Vector3f, 3> vertices;
  Eigen::Vector3f centroid;
  Eigen::Vector3f normal;  ///< unit; zero for a degenerate triangle
  std::uint32_t triangle;  ///< index in the mesh
};

std::vector<TriangleRecord> makeRecords(const TriangleMesh& mesh, const Vec3& origin, int threads = 1);

}  // namespace octoblisk
