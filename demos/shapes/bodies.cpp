#include "shapes/bodies.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "shapes/box.h"
#include "shapes/grid_mesh.h"
#include "shapes/seeded.h"

namespace octoblisk::shapes {

using Eigen::Vector2d;

SharedMesh scaled(const TriangleMesh& mesh, double factor) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex *= factor;
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

SharedMesh moved(const TriangleMesh& mesh, const Vec3& by) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex += by;
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

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

namespace {

/// A surface over the directions, divided by polar angle and azimuth. point_at(direction) gives a point that
/// is visible from the origin.
template <typename PointAt>
SharedMesh roundMesh(int segments, PointAt&& point_at) {
  const auto at = [&](double polar, double azimuth) -> Vec3 {
    return point_at(
        Vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
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

}  // namespace

SharedMesh bumpySphere(std::mt19937_64& random, double radius, double bump, int segments) {
  std::vector<Vec3> waves;
  for (int i = 0; i < 4; ++i) waves.push_back(randomPoint(random, 4.0));
  return roundMesh(segments, [&](const Vec3& direction) -> Vec3 {
    double height = 0.0;
    for (const Vec3& wave : waves) height += std::sin(wave.dot(direction) + wave.x());
    return direction * (radius + bump * height / static_cast<double>(waves.size()));
  });
}

SharedMesh ellipsoid(const Vec3& radii, int segments) {
  return roundMesh(segments, [&](const Vec3& direction) -> Vec3 { return radii.cwiseProduct(direction); });
}

SharedMesh teddy(double size, int segments) {
  struct Lobe {
    Vec3 direction;
    double height, narrowness;
  };
  const Lobe lobes[] = {{{0, 0, 1}, 0.30, 8},          {{0.62, 0, 0.8}, 0.16, 60},
                        {{-0.62, 0, 0.8}, 0.16, 60},   {{0, -0.5, 0.9}, 0.10, 60},
                        {{0.9, -0.4, 0.1}, 0.26, 25},  {{-0.9, -0.4, 0.1}, 0.26, 25},
                        {{0.6, -0.5, -0.7}, 0.28, 20}, {{-0.6, -0.5, -0.7}, 0.28, 20}};
  return roundMesh(segments, [&](const Vec3& direction) -> Vec3 {
    double radius = 0.3;
    for (const auto& [middle, height, narrowness] : lobes)
      radius += height * std::exp(narrowness * (direction.dot(middle.normalized()) - 1.0));
    return size * radius * direction;
  });
}

SharedMesh trefoilKnot(double scale, double tube_radius, int segments, int tube_segments) {
  return gridMesh(segments, tube_segments, true, true, [&](int i, int j) -> Vec3 {
    using std::sin, std::cos;
    const double t = 2.0 * std::numbers::pi * i / segments, v = 2.0 * std::numbers::pi * j / tube_segments;
    const Vec3 middle(sin(t) + 2.0 * sin(2.0 * t), cos(t) - 2.0 * cos(2.0 * t), -sin(3.0 * t));
    const Vec3 along(cos(t) + 4.0 * cos(2.0 * t), 4.0 * sin(2.0 * t) - sin(t), -3.0 * cos(3.0 * t));
    const Vec3 bend(-sin(t) - 8.0 * sin(2.0 * t), 8.0 * cos(2.0 * t) - cos(t), 9.0 * sin(3.0 * t));
    const Vec3 binormal = along.cross(bend).normalized();
    const Vec3 normal = binormal.cross(along).normalized();
    return scale * middle + tube_radius * (cos(v) * normal - sin(v) * binormal);
  });
}

SharedMesh jack(double half_length, double half_width) {
  const double w = half_width;
  std::vector<Vec3> vertices = box(Vec3(-w, -w, -w), Vec3(w, w, w)).vertices();
  std::vector<TriangleMesh::Indices> triangles;
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  };
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t out = 1u << axis, y = 1u << (axis + 1) % 3, z = 1u << (axis + 2) % 3;
    for (const bool is_high : {false, true}) {
      // Counter-clockwise seen from outside.
      std::uint32_t root[] = {0, y, y | z, z};
      if (!is_high) std::swap(root[1], root[3]);
      const auto tip = static_cast<std::uint32_t>(vertices.size());
      for (std::uint32_t& corner : root) {
        if (is_high) corner |= out;
        vertices.push_back(vertices[corner]);
        vertices.back()[axis] = is_high ? half_length : -half_length;
      }
      for (std::uint32_t k = 0; k < 4; ++k) quad(root[k], root[(k + 1) % 4], tip + (k + 1) % 4, tip + k);
      quad(tip, tip + 1, tip + 2, tip + 3);
    }
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh cylinder(double radius, double half_height, int segments) {
  std::vector<Vec3> vertices = {Vec3(0, 0, -half_height), Vec3(0, 0, half_height)};
  std::vector<TriangleMesh::Indices> triangles;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / segments;
    for (const double z : {-half_height, half_height})
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    const auto low = static_cast<std::uint32_t>(2 + 2 * i),
               next = static_cast<std::uint32_t>(2 + 2 * ((i + 1) % segments));
    triangles.push_back({0, next, low});
    triangles.push_back({1, low + 1, next + 1});
    triangles.push_back({low, next, next + 1});
    triangles.push_back({low, next + 1, low + 1});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

}  // namespace octoblisk::shapes
