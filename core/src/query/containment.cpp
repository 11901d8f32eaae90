#include "octoblisk/containment.h"

#include <limits>

#include "base/rounding.h"
#include "geometry/half_line_crossing.h"
#include "octoblisk/collide.h"
#include "query/locate_in_closed.h"
#include "query/ray_walk.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The rounding error of a half-line in double precision.
double roundingOf(const Tree& tree, const Vec3& point, const Pose& tree_in_a) {
  return kDoubleRounding * (point.norm() + tree_in_a.translation.norm() + tree.origin().norm());
}

/// The numbers of components of one surface inside and outside the other solid.
struct ComponentCount {
  std::size_t inside = 0, outside = 0;
};

ComponentCount countComponents(const Surface& of, const Pose& of_in_a, const Surface& in,
                               const Pose& in_in_a) {
  ComponentCount count;
  for (std::size_t component = 0; component < of.componentCount(); ++component) {
    const Vec3 point = of_in_a * of.position(of.cornerOfComponent(component));
    ++(locate(in, point, in_in_a) == PointLocation::inside ? count.inside : count.outside);
  }
  return count;
}

}  // namespace

PointLocation detail::locateInClosed(const ClusteredOctree& tree, const Vec3& point, const Pose& tree_in_a) {
  constexpr double kAll = std::numeric_limits<double>::infinity(), kStop = -1.0;
  bool odd = false, on_surface = false;
  // The half-line from the point along +x of frame A.
  const Ray ray{.origin = tree_in_a.inverse() * point, .direction = tree_in_a.rotation.row(0).transpose()};
  forEachCandidate(
      treeOf(tree), ray, roundingOf(treeOf(tree), point, tree_in_a), [&](std::uint32_t triangle) {
        const Crossing crossing = halfLineCrossing(point, tree_in_a * tree.mesh().triangle(triangle));
        odd ^= crossing == Crossing::crossed;
        on_surface |= crossing == Crossing::on_triangle;
        return on_surface ? kStop : kAll;
      });
  if (on_surface) return PointLocation::on_surface;
  return odd ? PointLocation::inside : PointLocation::outside;
}

PointLocation locate(const Surface& surface, const Vec3& point, const Pose& surface_in_a) {
  const PointLocation location = locateInClosed(surface.tree(), point, surface_in_a);
  if (location == PointLocation::on_surface || surface.isClosed()) return location;
  return PointLocation::unknown;
}

Containment containment(const Surface& a, const Surface& b, const Pose& b_in_a) {
  if (collide(a.tree(), b.tree(), b_in_a)) return Containment::touching;
  if (!a.isClosed() || !b.isClosed()) return Containment::unknown;
  // Each component of a surface is now wholly inside or outside the other solid. Where A and B share a point,
  // the shared region is bounded by a component of A's surface in B or one of B's in A; likewise for the
  // region of B that is not in A.
  const Pose identity;
  const ComponentCount of_a = countComponents(a, identity, b, b_in_a),
                       of_b = countComponents(b, b_in_a, a, identity);
  if (of_a.inside == 0 && of_b.inside == 0) return Containment::apart;
  if (of_a.inside == 0 && of_b.outside == 0) return Containment::b_inside_a;
  if (of_b.inside == 0 && of_a.outside == 0) return Containment::a_inside_b;
  return Containment::overlapping;
}

}  // namespace octoblisk
