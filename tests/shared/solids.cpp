#include "shared/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace octoblisk::testing {

bool Voxels::at(int i, int j, int k) const {
  const auto outside = [&](int index) { return index < 0 || index >= size; };
  if (outside(i) || outside(j) || outside(k)) return false;
  return full[static_cast<std::size_t>((i * size + j) * size + k)];
}

Voxels randomVoxels(std::mt19937_64& random, int size) {
  Voxels voxels{size, {}, nullptr};
  for (int i = 0; i < size * size * size; ++i) voxels.full.push_back(random() % 2 == 0);
  std::vector<Vec3> vertices;  // four per face, so equal positions have several indices
  std::vector<TriangleMesh::Indices> triangles;
  using Cell = Eigen::Vector3i;
  for (int cell_index = 0; cell_index < size * size * size; ++cell_index) {
    const Cell cell(cell_index / (size * size), cell_index / size % size, cell_index % size);
    if (!voxels.at(cell.x(), cell.y(), cell.z())) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        const Cell beyond = cell + (2 * side - 1) * Cell::Unit(axis);
        if (voxels.at(beyond.x(), beyond.y(), beyond.z())) continue;
        const Vec3 corner = (cell + side * Cell::Unit(axis)).cast<double>();
        const Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), {corner, corner + u, corner + u + v, corner + v});
        if (side == 1) {
          triangles.push_back({first, first + 1, first + 2});
          triangles.push_back({first, first + 2, first + 3});
        } else {
          triangles.push_back({first, first + 2, first + 1});
          triangles.push_back({first, first + 3, first + 2});
        }
      }
    }
  }
  voxels.mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  return voxels;
}

SharedMesh cup(double bottom_radius, double top_radius, double height, double wall, std::uint32_t segments) {
  const std::array<std::array<double, 2>, 4> radius_and_z = {{{bottom_radius, 0.0},
                                                              {top_radius, height},
                                                              {top_radius - wall, height},
                                                              {bottom_radius - wall, wall}}};
  std::vector<Vec3> vertices;
  for (const auto& [radius, z] : radius_and_z) {
    for (std::uint32_t j = 0; j < segments; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / segments;
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  const auto outside = static_cast<std::uint32_t>(vertices.size()), inside = outside + 1;
  vertices.emplace_back(0.0, 0.0, 0.0);
  vertices.emplace_back(0.0, 0.0, wall);
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t j = 0; j < segments; ++j) {
    const std::uint32_t next = (j + 1) % segments, last_ring = 3 * segments;
    triangles.push_back({outside, next, j});
    for (std::uint32_t ring = 0; ring < last_ring; ring += segments) {
      const std::uint32_t above = ring + segments;
      triangles.push_back({ring + j, ring + next, above + next});
      triangles.push_back({ring + j, above + next, above + j});
    }
    triangles.push_back({inside, last_ring + j, last_ring + next});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh deformed(const TriangleMesh& mesh, FunctionRef<Vec3(const Vec3&)> map) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(map(vertex));
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

SharedMesh moved(const TriangleMesh& mesh, const Pose& pose, double scale) {
  return deformed(mesh, [&](const Vec3& vertex) { return pose * Vec3(scale * vertex); });
}

SharedMesh scaledAndMoved(const SharedMesh& mesh, double scale, const Vec3& offset) {
  return deformed(*mesh, [&](const Vec3& vertex) { return Vec3(scale * vertex + offset); });
}

SharedMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3> vertices = a.vertices();
  std::vector<TriangleMesh::Indices> triangles = a.triangles();
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), b.vertices().begin(), b.vertices().end());
  for (const auto& [i, j, k] : b.triangles()) triangles.push_back({first + i, first + j, first + k});
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh insideOut(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Indices> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) triangles.push_back({a, c, b});
  return std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(triangles));
}

SharedMesh firstTriangles(const TriangleMesh& mesh, std::size_t count) {
  const auto end = mesh.triangles().begin() + static_cast<std::ptrdiff_t>(count);
  return std::make_shared<const TriangleMesh>(
      mesh.vertices(), std::vector<TriangleMesh::Indices>(mesh.triangles().begin(), end));
}

double windingNumber(const TriangleMesh& mesh, const Vec3& point) {
  double angle = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    const Vec3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle +=
        2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (4.0 * std::numbers::pi);
}

double bruteForceDistance(const Triangle& triangle, const Vec3& point) {
  const auto along = [&](const Vec3& from, const Vec3& to) {
    const double squared = (to - from).squaredNorm();
    const double part = squared > 0.0 ? std::clamp((point - from).dot(to - from) / squared, 0.0, 1.0) : 0.0;
    return (from + part * (to - from) - point).norm();
  };
  double least = std::min(
      {along(triangle[0], triangle[1]), along(triangle[1], triangle[2]), along(triangle[2], triangle[0])});
  // The closest point of the plane, by least squares: point ≈ corner + edges · weights.
  Eigen::Matrix<double, 3, 2> edges;
  edges << triangle[1] - triangle[0], triangle[2] - triangle[0];
  if (edges.col(0).cross(edges.col(1)).norm() > 1e-9 * edges.col(0).norm() * edges.col(1).norm()) {
    const Eigen::Vector2d weights = edges.colPivHouseholderQr().solve(point - triangle[0]);
    if (weights.minCoeff() >= 0.0 && weights.sum() <= 1.0) {
      least = std::min(least, (triangle[0] + edges * weights - point).norm());
    }
  }
  return least;
}

double bruteForceDistance(const TriangleMesh& mesh, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    least = std::min(least, bruteForceDistance(mesh.triangle(t), point));
  }
  return least;
}

}  // namespace octoblisk::testing
