// Surfaces over a grid of points.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::shapes {

/// Triangles over a grid of points(i, j), closed in i and/or j, facing ∂i × ∂j.
template <typename PointAt>
std::shared_ptr<const TriangleMesh> gridMesh(int count_i, int count_j, bool close_i, bool close_j,
                                             PointAt&& point_at) {
  std::vector<Vec3> vertices;
  for (int i = 0; i < count_i; ++i) {
    for (int j = 0; j < count_j; ++j) vertices.push_back(point_at(i, j));
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>((i % count_i) * count_j + j % count_j);
  };
  std::vector<TriangleMesh::Indices> triangles;
  for (int i = 0; i < count_i - !close_i; ++i) {
    for (int j = 0; j < count_j - !close_j; ++j) {
      triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::shapes
