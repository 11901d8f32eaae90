#include "octoblisk/collide.h"

#include "octoblisk/leaf_triangles.h"
#include "octoblisk/traversal.h"
#include "octoblisk/triangle_convex.h"
#include "octoblisk/triangle_pair.h"

namespace octoblisk {

std::optional<TrianglePair> collide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a) {
  std::optional<TrianglePair> hit;
  traversePairs(a, b, b_in_a, 0.0, [&](Child leaf_a, Child leaf_b) {
    const LeafTriangles in_a(a, leaf_a), in_b(b, leaf_b, &b_in_a);
    return forEachPairWithin(in_a, in_b, 0.0, [&](std::size_t i, std::size_t j) {
      if (!intersects(in_a[i], in_b[j])) return false;
      hit = TrianglePair{in_a.id(i), in_b.id(j)};
      return true;
    });
  });
  return hit;
}

std::optional<std::uint32_t> collide(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a) {
  std::optional<std::uint32_t> hit;
  const Aabb bounds = b.bounds();
  const Pose a_in_b = b_in_a.inverse();
  traverseBox(a, b_in_a * Obb{bounds.center(), Mat3::Identity(), bounds.halfExtents()}, 0.0, [&](Child leaf) {
    const LeafTriangles triangles(a, leaf, &a_in_b);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto contact = contactOf(triangles[i], b, 0.0);
      if (!contact || contact->distance > 0.0) continue;
      hit = triangles.id(i);
      return true;
    }
    return false;
  });
  return hit;
}

}  // namespace octoblisk
