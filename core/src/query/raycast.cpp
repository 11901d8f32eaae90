#include "octoblisk/raycast.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "geometry/ray_triangle.h"
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
  hit.back_face = crossing.back_face;
  return hit;
}

/// Calls `visit` for the crossings of a ray as long as t is of interest. `visit` returns the greatest t still
/// of interest, or a negative number to stop.
template <typename Visit>
void forEachCrossing(const ClusteredOctree& tree, const Ray& ray, Visit visit) {
  double limit = ray.t_max;
  forEachCandidate(treeOf(tree), ray, 0.0, [&](std::uint32_t triangle) {
    const auto found = crossing(ray.origin, ray.direction, tree.mesh().triangle(triangle));
    if (!found || found->t > limit || (found->back_face && ray.cull_back_faces)) return limit;
    return limit = std::min(limit, visit(RayCrossing{found->t, triangle, found->back_face}));
  });
}

}  // namespace

std::optional<RayHit> closestHit(const ClusteredOctree& tree, const Ray& ray) {
  RayCrossing best;
  forEachCrossing(tree, ray, [&](const RayCrossing& crossing) {
    if (std::tie(crossing.t, crossing.triangle) < std::tie(best.t, best.triangle)) best = crossing;
    return best.t;
  });
  if (best.triangle == kNoTriangle) return std::nullopt;
  return hitOf(tree.mesh(), ray, best);
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
