#include "query/thickness.h"

#include <algorithm>
#include <vector>

#include "octoblisk/raycast.h"

namespace octoblisk::detail {

double thinThickness(const ClusteredOctree& tree) {
  constexpr std::size_t kSamples = 64, kThin = kSamples / 10;
  const TriangleMesh& mesh = tree.mesh();
  std::vector<double> area_up_to(mesh.triangleCount());
  double area = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    area += 0.5 * scaledNormal(mesh.triangle(t)).norm();
    area_up_to[t] = area;
  }
  // Rays start slightly inside, so that they do not hit their own triangle.
  const double inward = 1e-6 * mesh.bounds().halfExtents().norm();
  std::vector<double> thickness;
  for (std::size_t s = 0; s < kSamples; ++s) {
    const double at = area * (static_cast<double>(s) + 0.5) / kSamples;
    const auto t = std::ranges::lower_bound(area_up_to, at) - area_up_to.begin();
    const Triangle triangle = mesh.triangle(static_cast<std::uint32_t>(t));
    Ray ray;
    ray.direction = -unitNormal(triangle);
    ray.origin = centroidOf(triangle) + inward * ray.direction;
    if (const auto hit = closestHit(tree, ray)) thickness.push_back(inward + hit->t);
  }
  if (thickness.empty()) return 0.0;
  const std::size_t thin = std::min(kThin, thickness.size() - 1);
  std::ranges::nth_element(thickness, thickness.begin() + static_cast<std::ptrdiff_t>(thin));
  return thickness[thin];
}

}  // namespace octoblisk::detail
