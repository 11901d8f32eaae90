#include "shared/meshes.h"

#include <cmath>
#include <numbers>

#include "shapes/grid_mesh.h"

namespace octoblisk::testing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

Pose randomPose(std::mt19937_64& random, double half_size) {
  const Mat3 rotation = randomRotation(random);
  return {rotation, randomPoint(random, half_size)};
}

Triangle randomTriangle(std::mt19937_64& random, double half_size) {
  Triangle triangle;
  for (Vec3& corner : triangle) corner = randomPoint(random, half_size);
  return triangle;
}

SharedMesh fan(int blades, int segments) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (int blade = 0; blade < blades; ++blade) {
    const auto one = shapes::gridMesh(segments + 1, 2 * segments, false, true, [&](int i, int j) -> Vec3 {
      const double span = static_cast<double>(i) / segments, round = kTurn * j / (2 * segments);
      const double chord = 0.5 * std::cos(round), thickness = 0.02 * std::sin(round),
                   stagger = 0.5 + 0.6 * span;
      const double z = chord * std::cos(stagger) - thickness * std::sin(stagger);
      const double y = chord * std::sin(stagger) + thickness * std::cos(stagger);
      return Eigen::AngleAxisd(kTurn * blade / blades, Vec3::UnitZ()) * Vec3(1.0 + span, y, z);
    });
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), one->vertices().begin(), one->vertices().end());
    for (const auto& [a, b, c] : one->triangles()) triangles.push_back({first + a, first + b, first + c});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh soup(std::mt19937_64& random, int triangles, double half_size, double triangle_size) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> indices;
  for (int t = 0; t < triangles; ++t) {
    const Vec3 center = randomPoint(random, half_size);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : randomTriangle(random, triangle_size)) vertices.push_back(center + corner);
    indices.push_back({first, first + 1, first + 2});
    switch (t % 32) {
      case 8:
        vertices[first + 2] = vertices[first + 1];
        break;  // a segment
      case 16:
        vertices[first + 2] = 0.5 * (vertices[first] + vertices[first + 1]);
        break;  // collinear
      case 24:
        vertices[first + 1] = vertices[first + 2] = vertices[first];
        break;  // a point
      case 31:
        indices.back() = indices[indices.size() / 2];
        break;  // a duplicate
      default:
        break;
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(indices));
}

SharedMesh tube(double inner, double outer, double half_height, std::uint32_t facets) {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const Eigen::Matrix<double, 4, 2> section{
      {outer, -half_height}, {outer, half_height}, {inner, half_height}, {inner, -half_height}};
  for (std::uint32_t i = 0; i < facets; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / facets;
    for (std::uint32_t k = 0; k < 4; ++k) {
      vertices.emplace_back(section(k, 0) * std::cos(angle), section(k, 0) * std::sin(angle), section(k, 1));
      const std::uint32_t here = 4 * i + k, above = 4 * i + (k + 1) % 4;
      const std::uint32_t next = 4 * ((i + 1) % facets) + k,
                          next_above = 4 * ((i + 1) % facets) + (k + 1) % 4;
      triangles.push_back({here, next, next_above});
      triangles.push_back({here, next_above, above});
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::testing
