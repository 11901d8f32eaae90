#include "shapes/bodies.h"

#include <cmath>
#include <numbers>

#include "shapes/box.h"
#include "shapes/grid_mesh.h"
#include "shapes/seeded.h"

namespace octoblisk::shapes {

using Eigen::Vector2d;

SharedMesh torus(double major_radius, double minor_radius, int major_segments, int minor_segments) {
  return gridMesh(major_segments, minor_segments, true, true, [&](int i, int j) -> Vec3 {
    const double u = 2.0 * std::numbers::pi * i / major_segments,
                 v = 2.0 * std::numbers::pi * j / minor_segments;
    const double radius = major_radius + minor_radius * std::cos(v);
    return {radius * std::cos(u), radius * std::sin(u), minor_radius * std::sin(v)};
  });
}

SharedMesh boxMesh(const Vec3& half_extents) {
  return std::make_shared<const TriangleMesh>(box(-half_extents, half_extents));
}

SharedMesh extrudedBand(const std::vector<Vector2d>& outer, const std::vector<Vector2d>& inner, bool is_ring,
                        double half_height) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    for (const Vector2d& p : {outer[i], inner[i]}) {
      for (const double z : {-half_height, half_height}) vertices.emplace_back(p.x(), p.y(), z);
    }
  }
  enum Corner : std::uint32_t { outer_low, outer_high, inner_low, inner_high };
  const auto at = [&](std::size_t i, Corner corner) {
    return static_cast<std::uint32_t>(4 * (i % outer.size()) + corner);
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  const std::size_t last = outer.size() - 1;
  for (std::size_t i = 0; i < (is_ring ? last + 1 : last); ++i) {
    quad(at(i, outer_low), at(i + 1, outer_low), at(i + 1, outer_high), at(i, outer_high));
    quad(at(i, inner_high), at(i + 1, inner_high), at(i + 1, inner_low), at(i, inner_low));
    quad(at(i, outer_high), at(i + 1, outer_high), at(i + 1, inner_high), at(i, inner_high));
    quad(at(i, inner_low), at(i + 1, inner_low), at(i + 1, outer_low), at(i, outer_low));
  }
  if (!is_ring) {
    quad(at(0, outer_low), at(0, outer_high), at(0, inner_high), at(0, inner_low));
    quad(at(last, inner_low), at(last, inner_high), at(last, outer_high), at(last, outer_low));
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh gear(int teeth, double root_radius, double tip_radius, double bore_radius, double half_height) {
  constexpr double kParts[] = {0.0, 0.4, 0.55, 0.85};  // root, root, tip, tip of each tooth
  std::vector<Vector2d> outer, inner;
  for (int tooth = 0; tooth < teeth; ++tooth) {
    for (std::size_t part = 0; part < 4; ++part) {
      const double angle = 2.0 * std::numbers::pi * (tooth + kParts[part]) / teeth;
      const Vector2d direction(std::cos(angle), std::sin(angle));
      outer.push_back((part < 2 ? root_radius : tip_radius) * direction);
      inner.push_back(bore_radius * direction);
    }
  }
  return extrudedBand(outer, inner, true, half_height);
}

SharedMesh uProfile(double half_width, double half_depth, double wall, double half_length) {
  const double x = half_width, y = half_depth;
  return extrudedBand({{-x, y}, {-x, -y}, {x, -y}, {x, y}},
                      {{wall - x, y}, {wall - x, wall - y}, {x - wall, wall - y}, {x - wall, y}}, false,
                      half_length);
}

SharedMesh bumpySphere(std::mt19937_64& random, double radius, double bump, int segments) {
  std::vector<Vec3> waves;
  for (int i = 0; i < 4; ++i) waves.push_back(randomPoint(random, 4.0));
  const auto at = [&](double polar, double azimuth) -> Vec3 {
    const Vec3 direction(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         std::cos(polar));
    double height = 0.0;
    for (const Vec3& wave : waves) height += std::sin(wave.dot(direction) + wave.x());
    return direction * (radius + bump * height / static_cast<double>(waves.size()));
  };
  std::vector<Vec3> vertices = {at(0.0, 0.0)};
  std::vector<TriangleMesh::Indices> triangles;
  const int rings = segments / 2;
  const auto index = [&](int ring, int i) {
    return static_cast<std::uint32_t>(1 + (ring - 1) * segments + i % segments);
  };
  for (int ring = 1; ring < rings; ++ring) {
    for (int i = 0; i < segments; ++i) {
      vertices.push_back(at(std::numbers::pi * ring / rings, 2.0 * std::numbers::pi * i / segments));
      if (ring == 1) {
        triangles.push_back({0, index(1, i), index(1, i + 1)});
      } else {
        triangles.push_back({index(ring - 1, i), index(ring, i), index(ring, i + 1)});
        triangles.push_back({index(ring - 1, i), index(ring, i + 1), index(ring - 1, i + 1)});
      }
    }
  }
  const auto last = static_cast<std::uint32_t>(vertices.size());
  vertices.push_back(at(std::numbers::pi, 0.0));
  for (int i = 0; i < segments; ++i)
    triangles.push_back({index(rings - 1, i), last, index(rings - 1, i + 1)});
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::shapes
