#include "toolpath/wheel_seat.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "models/require.h"
#include "models/shared_tree.h"
#include "models/triangle_tree.h"
#include "octoblisk/sweep.h"

namespace octoblisk::demos {
namespace {

/// A cylinder about z whose facets enclose the true one.
TriangleMesh cylinderRound(double radius, double width) {
  constexpr std::uint32_t kSegments = 360;
  const double outside = radius / std::cos(std::numbers::pi / kSegments);
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t k = 0; k < kSegments; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSegments;
    for (const double z : {-0.5 * width, 0.5 * width}) {
      vertices.emplace_back(outside * std::cos(angle), outside * std::sin(angle), z);
    }
  }
  const auto low = static_cast<std::uint32_t>(vertices.size()), high = low + 1;
  vertices.emplace_back(0.0, 0.0, -0.5 * width);
  vertices.emplace_back(0.0, 0.0, 0.5 * width);
  for (std::uint32_t k = 0; k < kSegments; ++k) {
    const std::uint32_t here = 2 * k, next = 2 * ((k + 1) % kSegments);
    triangles.insert(
        triangles.end(),
        {{here, next, next + 1}, {here, next + 1, here + 1}, {low, next, here}, {high, here + 1, next + 1}});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

}  // namespace

WheelSeat::WheelSeat(const TriangleMesh& blisk, std::span<const int> blade_of_triangle, int blade,
                     double radius, double width) {
  require(radius > 0.0 && width > 0.0, "the wheel's radius and width must be above 0 mm");
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < blade_of_triangle.size(); ++t) {
    if (blade_of_triangle[t] == blade) triangles.push_back(blisk.triangles()[t]);
  }
  require(!triangles.empty(), "the blade has no triangles");
  blade_ = treeOfTriangles(blisk, std::move(triangles));
  wheel_ = treeOf(cylinderRound(radius, width));
}

Pose WheelSeat::seated(const Pose& tool_in_blisk, const Vec3& normal, double depth) const {
  constexpr double kTouch = 1e-3;  // mm
  const auto shifted = [&](double distance) {
    return Pose{tool_in_blisk.rotation, tool_in_blisk.translation + distance * normal};
  };
  for (const double lift : {1.0, 4.0, 16.0}) {
    // The given pose touches at one point at least, so this motion ends inside the blade.
    const Pose from = shifted(lift), to = shifted(-1.0);
    const auto touch = sweep(*blade_, *wheel_, Motion(from, to), kTouch);
    if (!touch) return tool_in_blisk;
    if (touch->fraction > 0.0) return shifted(lift - touch->fraction * (lift + 1.0) - depth);
  }
  return tool_in_blisk;
}

}  // namespace octoblisk::demos
