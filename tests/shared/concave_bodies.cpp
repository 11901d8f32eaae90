#include "shared/concave_bodies.h"

#include <cmath>
#include <numbers>

namespace octoblisk::testing {

using Eigen::Vector2d;

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

double trayHeight(double x, double y) {
  const double squared = x * x + y * y;
  return 0.15 * std::sin(x) * std::cos(y) + 0.003 * squared * squared;
}

SharedMesh tray(double half_size, int segments) {
  const SharedMesh flat = waveSheet(half_size, 0.0, segments);
  std::vector<Vec3> vertices = flat->vertices();
  for (Vec3& vertex : vertices) vertex.z() = trayHeight(vertex.x(), vertex.y());
  return std::make_shared<const TriangleMesh>(std::move(vertices), flat->triangles());
}

}  // namespace octoblisk::testing
