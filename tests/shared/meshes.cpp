#include "shared/meshes.h"

#include <cmath>
#include <numbers>

namespace octoblisk::testing {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Triangles over a grid of points(i, j), closed in i and/or j, facing ∂i × ∂j.
template <typename PointAt>
SharedMesh gridMesh(int count_i, int count_j, bool close_i, bool close_j, PointAt&& point_at) {
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

}  // namespace

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

Vec3 randomPoint(std::mt19937_64& random, double half_size) {
  const double x = uniform(random, -half_size, half_size), y = uniform(random, -half_size, half_size);
  return {x, y, uniform(random, -half_size, half_size)};
}

Mat3 randomRotation(std::mt19937_64& random) {
  Eigen::Vector4d q;
  do {
    for (int k = 0; k < 4; ++k) q[k] = uniform(random, -1.0, 1.0);
  } while (q.squaredNorm() > 1.0 || q.squaredNorm() < 0.01);
  return Eigen::Quaterniond(q.normalized()).toRotationMatrix();
}

Pose randomPose(std::mt19937_64& random, double half_size) {
  const Mat3 rotation = randomRotation(random);
  return {rotation, randomPoint(random, half_size)};
}

Triangle randomTriangle(std::mt19937_64& random, double half_size) {
  Triangle triangle;
  for (Vec3& corner : triangle) corner = randomPoint(random, half_size);
  return triangle;
}

SharedMesh torus(double major_radius, double minor_radius, int major_segments, int minor_segments) {
  return gridMesh(major_segments, minor_segments, true, true, [&](int i, int j) -> Vec3 {
    const double u = kTurn * i / major_segments, v = kTurn * j / minor_segments;
    const double radius = major_radius + minor_radius * std::cos(v);
    return {radius * std::cos(u), radius * std::sin(u), minor_radius * std::sin(v)};
  });
}

SharedMesh boxMesh(const Vec3& half_extents) {
  std::vector<Vec3> vertices;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 side(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    vertices.push_back(side.cwiseProduct(half_extents));
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices),
                                              std::vector<TriangleMesh::Indices>{{0, 2, 3},
                                                                                 {0, 3, 1},
                                                                                 {4, 5, 7},
                                                                                 {4, 7, 6},
                                                                                 {0, 1, 5},
                                                                                 {0, 5, 4},
                                                                                 {2, 6, 7},
                                                                                 {2, 7, 3},
                                                                                 {0, 4, 6},
                                                                                 {0, 6, 2},
                                                                                 {1, 3, 7},
                                                                                 {1, 7, 5}});
}

SharedMesh waveSheet(double half_size, double height, int segments) {
  return gridMesh(segments + 1, segments + 1, false, false, [&](int i, int j) -> Vec3 {
    const double x = half_size * (2.0 * i / segments - 1.0), y = half_size * (2.0 * j / segments - 1.0);
    return {x, y, height * std::sin(x) * std::cos(y)};
  });
}

SharedMesh fan(int blades, int segments) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (int blade = 0; blade < blades; ++blade) {
    const auto one = gridMesh(segments + 1, 2 * segments, false, true, [&](int i, int j) -> Vec3 {
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

}  // namespace octoblisk::testing
