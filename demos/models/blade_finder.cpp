#include "models/blade_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "models/blade_cut.h"
#include "models/growing_parts.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Whether a triangle may be a facet of a surface of revolution about Z. A large facet's normal may be off by
/// the angle that the facet spans.
bool isOfRevolution(const Triangle& t) {
  constexpr double kTolerance = 0.05;
  const Vec3 centroid = centroidOf(t);
  const Vec3 e_theta = Vec3(-centroid.y(), centroid.x(), 0.0).normalized();
  double half_width = 0.0;
  for (const Vec3& corner : t) half_width = std::max(half_width, std::abs(corner.dot(e_theta)));
  const double tolerance = std::max(kTolerance, half_width / radiusOf(centroid));
  return std::abs(unitNormal(t).dot(e_theta)) <= tolerance;
}

/// Grows the blades down to the hub and up to the shroud.
void flood(const WeldedSurface& surface, std::vector<int>& blade_of_triangle) {
  const auto beside = surface.neighbours();
  std::vector<std::uint32_t> front;
  for (std::uint32_t t = 0; t < blade_of_triangle.size(); ++t) {
    if (blade_of_triangle[t] != 0) front.push_back(t);
  }
  for (std::size_t k = 0; k < front.size(); ++k) {
    const int blade = blade_of_triangle[front[k]];
    for (const std::uint32_t t : beside[front[k]]) {
      if (blade_of_triangle[t] != 0 || isOfRevolution(surface.mesh.triangle(t))) continue;
      blade_of_triangle[t] = blade;
      front.push_back(t);
    }
  }
}

/// The angle of each blade's leading edge at the tip, in [0, 2π).
std::vector<double> tipAngles(const WeldedSurface& surface, const BladesFound& found) {
  constexpr double kTipPart = 0.02;  // of the blade's height
  const double tip_from = found.tip_radius - kTipPart * (found.tip_radius - found.root_radius);
  std::vector<Vec3> foremost(found.count, Vec3(0.0, 0.0, std::numeric_limits<double>::infinity()));
  for (std::size_t t = 0; t < surface.corners.size(); ++t) {
    const int blade = found.blade_of_triangle[t];
    if (blade == 0) continue;
    for (const Vec3& corner : surface.mesh.triangle(t)) {
      if (radiusOf(corner) >= tip_from && corner.z() < foremost[blade - 1].z()) foremost[blade - 1] = corner;
    }
  }
  std::vector<double> angles;
  for (const Vec3& point : foremost) {
    const double angle = std::atan2(point.y(), point.x());
    angles.push_back(angle < 0.0 ? angle + kTurn : angle);
  }
  return angles;
}

/// Numbers the blades in the order of their tips, from the one nearest to angle 0.
void renumber(const WeldedSurface& surface, BladesFound& found) {
  const std::vector<double> angles = tipAngles(surface, found);
  const auto from_zero = [&](int k) { return std::min(angles[k], kTurn - angles[k]); };
  std::vector<int> order(found.count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return angles[a] < angles[b]; });
  const auto nearest =
      std::min_element(order.begin(), order.end(), [&](int a, int b) { return from_zero(a) < from_zero(b); });
  std::rotate(order.begin(), nearest, order.end());
  std::vector<int> number(found.count + 1, 0);
  for (int k = 0; k < found.count; ++k) number[order[k] + 1] = k + 1;
  for (int& blade : found.blade_of_triangle) blade = number[blade];
}

/// Height divided by mean thickness, over all blades together. The field radius · angle · e_theta has the
/// divergence 1 and does not flow through a surface of revolution; a blade's open root counts as one. So its
/// outflow is the volume.
double slenderness(const TriangleMesh& mesh, const BladesFound& found) {
  std::vector<double> volume(found.count, 0.0), first_angle(found.count, kTurn);
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const int blade = found.blade_of_triangle[t];
    if (blade == 0) continue;
    const Triangle corners = mesh.triangle(t);
    const Vec3 centroid = centroidOf(corners);
    const double angle = std::atan2(centroid.y(), centroid.x());
    if (first_angle[blade - 1] == kTurn) first_angle[blade - 1] = angle;
    const double turn = std::remainder(angle - first_angle[blade - 1], kTurn);
    const Vec3 normal = 0.5 * scaledNormal(corners);  // its length is the triangle's area
    volume[blade - 1] += turn * (centroid.x() * normal.y() - centroid.y() * normal.x());
    area += normal.norm();
  }
  double whole = 0.0;
  for (const double each : volume) whole += std::abs(each);  // the mesh may face inward
  return (found.tip_radius - found.root_radius) * 0.5 * area / whole;
}

}  // namespace

BladesFound findBlades(const TriangleMesh& mesh) {
  BladesFound found;
  found.blade_of_triangle.assign(mesh.triangleCount(), 0);
  const WeldedSurface surface(mesh);
  const BladeCut cut = findBladeCut(surface);
  if (cut.count == 0) return found;

  GrowingParts growing(surface);
  growing.addBetween(cut.low, cut.high);
  std::map<std::uint32_t, int> blade_of_root;
  for (const Part& part : bladesAmong(growing.parts())) blade_of_root[part.root] = ++found.count;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!(surface.low[t] > cut.low && surface.high[t] < cut.high)) continue;
    const auto blade = blade_of_root.find(growing.rootOf(surface.corners[t][0]));
    if (blade != blade_of_root.end()) found.blade_of_triangle[t] = blade->second;
  }
  flood(surface, found.blade_of_triangle);

  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const bool of_blade = found.blade_of_triangle[t] != 0;
    const bool of_hub = !of_blade && surface.low[t] <= cut.low;
    if (of_blade) found.tip_radius = std::max(found.tip_radius, surface.high[t]);
    if (of_hub) found.root_radius = std::max(found.root_radius, surface.high[t]);
  }
  const bool has_hub = found.root_radius > 0.0;
  if (!has_hub) found.root_radius = cut.low;
  constexpr double kMinSlenderness = 3.0;
  if (!(slenderness(mesh, found) >= kMinSlenderness)) {
    BladesFound none;
    none.blade_of_triangle.assign(mesh.triangleCount(), 0);
    return none;
  }
  found.shrouded = std::isfinite(cut.high);
  renumber(surface, found);
  return found;
}

}  // namespace octoblisk::demos
