#include "octoblisk/raycast.h"

#include <algorithm>
#include <tuple>

#include "query/ray_walk.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

RayHit hitOf(const TriangleMesh& mesh, const Ray& ray, const RayCrossing& crossing) {
  RayHit hit;
  hit.t = crossing.t;
  hit.triangle = crossing.triangle;
  hit.point = ray.origin + crossing.t * ray.direction;
  hit.normal = scaledNormal(mesh.triangle(crossing.triangle)).stableNormalized();
  hit.back_face = crossing.back_face;
  return hit;
}

/// walkRay for any callable.
template <typename Visit>
void forEachCrossing(const ClusteredOctree& tree, const Ray& ray, Visit visit) {
  walkRay(
      treeOf(tree), ray,
      [](void* function, const RayCrossing& crossing) { return (*static_cast<Visit*>(function))(crossing); },
      &visit);
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
