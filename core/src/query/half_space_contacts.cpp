#include "octoblisk/half_space_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/frame_along.h"
#include "octoblisk/triangles_in_box.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

void contacts(const ClusteredOctree& a, const HalfSpace& b_in_a, double threshold,
              std::vector<Contact>& found) {
  found.clear();
  const Tree& tree = treeOf(a);
  // A box around the part of the mesh within reach: as wide as the mesh, and down to its deepest point.
  const Vec3& normal = b_in_a.normal;
  const double height = normal.dot(tree.origin()) - b_in_a.offset;
  const double lowest = -tree.radius(),
               highest = std::min(threshold - height, tree.radius());  // from the origin
  if (!std::isfinite(height) || !(lowest <= highest + 1e-12 * (tree.origin().norm() + tree.radius()))) return;
  Obb below;
  below.axes = frameAlong(normal);
  below.center = tree.origin() + 0.5 * (lowest + highest) * normal;
  below.half_extents = Vec3(std::max(0.5 * (highest - lowest), 0.0), tree.radius(), tree.radius());

  // Until the end, triangle_b holds the vertex.
  forEachTriangleIn(a, below, 0.0, [&](std::uint32_t triangle) {
    for (const std::uint32_t vertex : a.mesh().triangles()[triangle]) {
      const Vec3& corner = a.mesh().vertices()[vertex];
      const double distance = normal.dot(corner) - b_in_a.offset;
      if (distance > threshold) continue;
      found.push_back({corner, corner - distance * normal, normal, distance, triangle, vertex});
    }
    return false;
  });
  std::ranges::sort(found, {}, [](const Contact& c) { return std::tuple(c.triangle_b, c.triangle_a); });
  const auto areOfOneVertex = [](const Contact& one, const Contact& other) {
    return one.triangle_b == other.triangle_b;
  };
  found.erase(std::unique(found.begin(), found.end(), areOfOneVertex), found.end());
  std::ranges::sort(found, {}, [](const Contact& c) { return std::tuple(c.triangle_a, c.triangle_b); });
  for (Contact& contact : found) contact.triangle_b = kNoTriangle;
}

}  // namespace octoblisk
