// Meshes made of several boxes.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"
#include "shared/block.h"

namespace octoblisk::demos {

using testing::block;

inline TriangleMesh moved(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& v : vertices) v += by;
  return {vertices, mesh.triangles()};
}

inline TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> vertices = a.vertices();
  vertices.insert(vertices.end(), b.vertices().begin(), b.vertices().end());
  std::vector<TriangleMesh::Indices> triangles = a.triangles();
  const auto first = static_cast<std::uint32_t>(a.vertices().size());
  for (const auto& [i, j, k] : b.triangles()) triangles.push_back({first + i, first + j, first + k});
  return {vertices, triangles};
}

/// Without rotation.
inline Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

}  // namespace octoblisk::demos
