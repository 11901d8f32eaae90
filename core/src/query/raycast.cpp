#include "octoblisk/raycast.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "geometry/ray_triangle.h"
#include "octoblisk/batch.h"
#include "query/ray_walk.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

struct RayCrossing {
  double t = std::numeric_limits<double>::infinity();
  std::uint32_t triangle = kNoTriangle;
  bool back_face = false;
};

RayHit hitOf(const TriangleMesh& mesh, const Ray& ray, const RayCrossing& crossing) {
  RayHit hit;
  hit.t = crossing.t;
  hit.triangle = crossing.triangle;
  hit.point = ray.origin + crossing.t * ray.direction;
  hit.normal = scaledNormal(mesh.triangle(crossing.triangle)).stableNormalized();
  if (hit.normal.isZero()) hit.normal = (crossing.back_face ? 1.0 : -1.0) * ray.direction.stableNormalized();
  hit.back_face = crossing.back_face;
  return hit;
}

/// The crossing of a ray and a triangle that a query counts, with t at most `limit`.
std::optional<RayCrossing> crossingOf(const ClusteredOctree& tree, const Ray& ray, std::uint32_t triangle,
                                      double limit) {
  const auto found = crossing(ray.origin, ray.direction, tree.mesh().triangle(triangle));
  if (!found || found->t > limit || (found->back_face && ray.cull_back_faces)) return std::nullopt;
  return RayCrossing{found->t, triangle, found->back_face};
}

/// Calls `visit` for the crossings of a ray as long as t is of interest. `visit` returns the greatest t still
/// of interest, or a negative number to stop.
template <typename Visit>
void forEachCrossing(const ClusteredOctree& tree, const Ray& ray, Visit visit) {
  double limit = ray.t_max;
  forEachCandidate(treeOf(tree), ray, 0.0, [&](std::uint32_t triangle) {
    if (const auto found = crossingOf(tree, ray, triangle, limit)) limit = std::min(limit, visit(*found));
    return limit;
  });
}

/// The search for the crossing with the least t.
struct ClosestCrossing {
  RayCrossing best;

  /// Returns the greatest t still of interest.
  double offer(const ClusteredOctree& tree, const Ray& ray, std::uint32_t triangle) {
    const auto found = crossingOf(tree, ray, triangle, std::min(best.t, ray.t_max));
    if (found && std::tie(found->t, found->triangle) < std::tie(best.t, best.triangle)) best = *found;
    return std::min(best.t, ray.t_max);
  }

  std::optional<RayHit> hit(const ClusteredOctree& tree, const Ray& ray) const {
    return best.triangle == kNoTriangle ? std::nullopt : std::optional(hitOf(tree.mesh(), ray, best));
  }
};

}  // namespace

std::optional<RayHit> closestHit(const ClusteredOctree& tree, const Ray& ray) {
  ClosestCrossing closest;
  forEachCandidate(treeOf(tree), ray, 0.0,
                   [&](std::uint32_t triangle) { return closest.offer(tree, ray, triangle); });
  return closest.hit(tree, ray);
}

std::vector<std::optional<RayHit>> closestHitAll(const ClusteredOctree& tree, std::span<const Ray> rays,
                                                 int threads) {
  constexpr std::size_t kRaysAtOnce = 256;  // few descents idle at the end of a group; the load is balanced
  std::vector<std::optional<RayHit>> hits(rays.size());
  parallelForChunks(rays.size(), kRaysAtOnce, threads, [&](std::size_t begin, std::size_t end) {
    const std::span<const Ray> of_group = rays.subspan(begin, end - begin);
    std::array<ClosestCrossing, kRaysAtOnce> closest;
    forEachCandidate(treeOf(tree), of_group, [&](std::size_t ray, std::uint32_t triangle) {
      return closest[ray].offer(tree, of_group[ray], triangle);
    });
    for (std::size_t k = 0; k < of_group.size(); ++k) hits[begin + k] = closest[k].hit(tree, of_group[k]);
  });
  return hits;
}

bool anyHit(const ClusteredOctree& tree, const Ray& ray) {
  bool found = false;
  forEachCrossing(tree, ray, [&](const RayCrossing&) {
    found = true;
    return -1.0;
  });
  return found;
}

void allHits(const ClusteredOctree& tree, const Ray& ray, std::vector<RayHit>& found) {
  found.clear();
  forEachCrossing(tree, ray, [&](const RayCrossing& crossing) {
    found.push_back(hitOf(tree.mesh(), ray, crossing));
    return ray.t_max;
  });
  std::ranges::sort(found, {}, [](const RayHit& hit) { return std::tie(hit.t, hit.triangle); });
}

}  // namespace octoblisk
