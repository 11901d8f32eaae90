#include "cell/fine_features.h"

#include <algorithm>
#include <utility>

#include "octoblisk/closest_point.h"
#include "octoblisk/parallel.h"

namespace octoblisk::demos {
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

}  // namespace

FineFeatures fineFeatures(const octoblisk::Surface& surface, double depth, int threads) {
  const ClusteredOctree& tree = surface.tree();
  const TriangleMesh& mesh = tree.mesh();
  std::vector<char> fine(mesh.triangleCount(), 1);
  if (surface.isOriented()) {
    constexpr std::size_t kAtOnce = 1024;
    parallelFor((fine.size() + kAtOnce - 1) / kAtOnce, threadCount(threads),
                [&](std::size_t block, std::size_t) {
                  const std::size_t end = std::min(fine.size(), (block + 1) * kAtOnce);
                  for (std::size_t t = block * kAtOnce; t < end; ++t) {
                    fine[t] = isFine(tree, static_cast<std::uint32_t>(t), depth);
                  }
                });
  }
  FineFeatures found;
  std::vector<TriangleMesh::Indices> corners;
  for (std::uint32_t t = 0; t < fine.size(); ++t) {
    if (!fine[t]) continue;
    found.triangles.push_back(t);
    corners.push_back(mesh.triangles()[t]);
  }
  if (corners.empty()) return found;
  auto part = std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(corners));
  found.tree = std::make_shared<const ClusteredOctree>(ClusteredOctree::build(std::move(part)));
  return found;
}

}  // namespace octoblisk::demos
