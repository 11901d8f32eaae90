#include "models/blade_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "models/require.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

double areaOf(const Triangle& t) { return 0.5 * scaledNormal(t).norm(); }

/// The flow of the field θ e_theta out of the blades, whose divergence is 1/radius > 0. None flows through an
/// open root, a surface of revolution.
double outflow(const TriangleMesh& blisk, const BladesFound& blades) {
  std::vector<double> first_angle(blades.count, std::numeric_limits<double>::quiet_NaN());
  double sum = 0.0;
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    const int blade = blades.blade_of_triangle[t];
    if (blade == 0) continue;
    const Triangle corners = blisk.triangle(t);
    const Vec3 center = centroidOf(corners);
    const double angle = std::atan2(center.y(), center.x());
    double& first = first_angle[blade - 1];
    if (std::isnan(first)) first = angle;
    const Vec3 e_theta = Vec3(-center.y(), center.x(), 0.0).normalized();
    sum += std::remainder(angle - first, 2.0 * std::numbers::pi) * scaledNormal(corners).dot(e_theta);
  }
  return sum;
}

/// Grows blades along their edges into triangles that looked like a surface of revolution.
void adoptEdges(const TriangleMesh& blisk, const Neighbours& beside, std::vector<int>& blade_of_triangle) {
  constexpr double kSmooth = 0.7;      // cosine from triangle to triangle; the edges may be rounded coarsely
  constexpr double kAlongAxis = 0.75;  // of the normal
  const auto normalOf = [&](std::uint32_t t) { return unitNormal(blisk.triangle(t)); };
  std::vector<std::uint32_t> front;
  for (std::uint32_t t = 0; t < blade_of_triangle.size(); ++t) {
    if (blade_of_triangle[t] != 0) front.push_back(t);
  }
  for (std::size_t k = 0; k < front.size(); ++k) {
    for (const std::uint32_t t : beside[front[k]]) {
      if (blade_of_triangle[t] != 0) continue;
      const Vec3 normal = normalOf(t);
      if (std::abs(normal.z()) < kAlongAxis || normal.dot(normalOf(front[k])) < kSmooth) continue;
      blade_of_triangle[t] = blade_of_triangle[front[k]];
      front.push_back(t);
    }
  }
}

BladePart partFacing(const Triangle& t, double outwards) {
  constexpr double kAtTip = 0.7;
  const Vec3 center = centroidOf(t);
  const Vec3 e_r = Vec3(center.x(), center.y(), 0.0).normalized();
  const Vec3 normal = outwards * unitNormal(t);
  if (normal.dot(e_r) > kAtTip) return BladePart::tip;
  const Vec3 e_theta(-e_r.y(), e_r.x(), 0.0);
  return normal.dot(e_theta) > 0.0 ? BladePart::forward : BladePart::backward;
}

/// Small islands of a part join the part that most of their border touches.
void dissolveIslands(const TriangleMesh& blisk, const Neighbours& beside, int blade_count,
                     BladeSides& sides) {
  constexpr double kSmall = 0.02;  // of the blade
  constexpr int kRounds = 3;       // an island may lie in an island
  std::vector<double> blade_area(blade_count + 1, 0.0);
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    blade_area[sides.blade_of_triangle[t]] += areaOf(blisk.triangle(t));
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<bool> seen(blisk.triangleCount(), false);
    for (std::uint32_t start = 0; start < blisk.triangleCount(); ++start) {
      const BladePart part = sides.part_of_triangle[start];
      if (seen[start] || part == BladePart::not_of_blade) continue;
      const int blade = sides.blade_of_triangle[start];
      std::vector<std::uint32_t> island = {start};
      seen[start] = true;
      double area = 0.0;
      std::array<int, 4> border = {};
      for (std::size_t k = 0; k < island.size(); ++k) {
        area += areaOf(blisk.triangle(island[k]));
        for (const std::uint32_t t : beside[island[k]]) {
          if (sides.blade_of_triangle[t] != blade) continue;
          const BladePart beyond = sides.part_of_triangle[t];
          if (beyond != part) ++border[static_cast<std::size_t>(beyond)];
          if (beyond != part || seen[t]) continue;
          seen[t] = true;
          island.push_back(t);
        }
      }
      // A tip is thin, so it may be small; a tip part beside only one side is a speck.
      const bool between_sides = border[1] > 0 && border[2] > 0;
      if (area > kSmall * blade_area[blade] || (part == BladePart::tip && between_sides && island.size() > 4))
        continue;
      const auto most = std::max_element(border.begin(), border.end());
      if (*most == 0) continue;
      for (const std::uint32_t t : island) {
        sides.part_of_triangle[t] = static_cast<BladePart>(most - border.begin());
      }
    }
  }
}

}  // namespace

BladeSides findBladeSides(const TriangleMesh& blisk, const BladesFound& blades) {
  require(blades.blade_of_triangle.size() == blisk.triangleCount(),
          "the blade numbers are not for this mesh");
  const Neighbours beside = WeldedSurface(blisk).neighbours();
  BladeSides sides;
  sides.faces_outward = outflow(blisk, blades) >= 0.0;
  sides.blade_of_triangle = blades.blade_of_triangle;
  adoptEdges(blisk, beside, sides.blade_of_triangle);
  const double outwards = sides.faces_outward ? 1.0 : -1.0;
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    sides.part_of_triangle.push_back(
        sides.blade_of_triangle[t] == 0 ? BladePart::not_of_blade : partFacing(blisk.triangle(t), outwards));
  }
  dissolveIslands(blisk, beside, blades.count, sides);
  return sides;
}

}  // namespace octoblisk::demos
