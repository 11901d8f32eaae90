// A box whose faces are grids of triangles.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

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

}  // namespace octoblisk::testing
