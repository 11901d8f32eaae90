#include "grinding/fine_features.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

bool isFine(const ClusteredOctree& tree, std::uint32_t index, double depth) {
  constexpr double kNearer = 0.96;
  const Triangle triangle = tree.mesh().triangle(index);
  const Vec3 normal = scaledNormal(triangle);
  if (normal.isZero()) return true;
  const Vec3 inward = -depth * normal.normalized();
  const auto isNear = [&](const Vec3& point) {
    return closestPoint(tree, point + inward, kNearer * depth).has_value();
  };
  if (isNear((triangle[0] + triangle[1] + triangle[2]) / 3.0)) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (isNear(triangle[i]) || isNear(0.5 * (triangle[i] + triangle[(i + 1) % 3]))) return true;
  }
  return false;
}

/// Whether an axis parts the triangle from the box.
bool isBeside(const Triangle& triangle, const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] = std::minmax({triangle[0][axis], triangle[1][axis], triangle[2][axis]});
    if (least > box.max[axis] || greatest < box.min[axis]) return true;
  }
  return false;
}

}  // namespace

std::vector<std::uint32_t> fineFeatures(const SolidBoundary& boundary, double depth, int threads) {
  const ClusteredOctree& tree = boundary.surface().tree();
  std::vector<char> fine(tree.mesh().triangleCount(), 1);
  constexpr std::size_t kAtOnce = 1024;
  parallelFor((fine.size() + kAtOnce - 1) / kAtOnce, threadCount(threads),
              [&](std::size_t block, std::size_t) {
                const auto end = static_cast<std::uint32_t>(std::min(fine.size(), (block + 1) * kAtOnce));
                for (auto t = static_cast<std::uint32_t>(block * kAtOnce); t < end; ++t) {
                  if (boundary.has(t)) fine[t] = isFine(tree, t, depth);
                }
              });
  std::vector<std::uint32_t> found;
  for (std::uint32_t t = 0; t < fine.size(); ++t) {
    if (fine[t]) found.push_back(t);
  }
  return found;
}

std::optional<DeepPoint> deepestBeyond(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                                       const octoblisk::Surface& solid, const Pose& mesh_in_solid,
                                       double limit) {
  const Aabb& bounds = solid.tree().mesh().bounds();
  std::optional<DeepPoint> deepest;
  constexpr double kBeyond = 1.05, kDeeper = 1.1;
  double best = limit;
  double enough = kBeyond * limit;  // what a part must exceed to be of interest
  std::vector<Triangle> parts;
  for (const std::uint32_t index : triangles) {
    const Triangle triangle = mesh_in_solid * mesh.triangle(index);
    if (isBeside(triangle, bounds)) continue;
    parts.push_back(triangle);
    while (!parts.empty()) {
      const auto [a, b, c] = parts.back();
      parts.pop_back();
      const Vec3 middle = (a + b + c) / 3.0;
      const double reach = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
      const double distance = closestPoint(solid.tree(), middle).value().distance;
      if (distance + reach <= enough) continue;
      const bool is_inside = locate(solid, middle) == PointLocation::inside;
      if (!is_inside && distance >= reach) continue;
      if (is_inside && distance > best) {
        best = distance;
        deepest = {distance, mesh_in_solid.inverse() * middle, index};
        enough = kDeeper * distance;
      }
      const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      parts.insert(parts.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
  }
  return deepest;
}

}  // namespace octoblisk::demos
