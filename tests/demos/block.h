// A box whose faces are grids of triangles, and meshes made of several boxes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// 12 · steps² triangles, facing outward.
inline TriangleMesh block(const Vec3& half, int steps) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = known.try_emplace(at, static_cast<std::uint32_t>(vertices.size()));
    if (is_new) {
      vertices.emplace_back();
      for (int k = 0; k < 3; ++k) vertices.back()[k] = half[k] * (2.0 * at[k] / steps - 1.0);
    }
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, steps}) {
      for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[u] = i + di;
            at[v] = j + dj;
            return vertex(at);
          };
          std::array<std::uint32_t, 4> square = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::swap(square[1], square[3]);
          triangles.push_back({square[0], square[1], square[2]});
          triangles.push_back({square[0], square[2], square[3]});
        }
      }
    }
  }
  return {vertices, triangles};
}

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
