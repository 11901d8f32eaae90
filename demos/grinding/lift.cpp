#include "grinding/lift.h"

#include "octoblisk/collide.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"
#include "query/solid_parts.h"

namespace octoblisk::demos {

namespace {

template <typename IsInA>
bool areNestedBy(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a,
                 const IsInA& is_in_a) {
  for (std::size_t k = 0; k < b.componentCount(); ++k) {
    if (is_in_a(b_in_a * b.position(b.cornerOfComponent(k)))) return true;
  }
  for (std::size_t k = 0; b.isClosed() && k < a.componentCount(); ++k) {
    if (locate(b, a.position(a.cornerOfComponent(k)), b_in_a) == PointLocation::inside) return true;
  }
  return false;
}

}  // namespace

bool areNested(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a) {
  return areNestedBy(a, b, b_in_a,
                     [&](const Vec3& point) { return locate(a, point) == PointLocation::inside; });
}

bool areNestedIfCapped(const octoblisk::Surface& a, const octoblisk::Surface& b, const Pose& b_in_a) {
  // A point on the mesh counts as inside, so that nothing is proved there.
  return areNestedBy(a, b, b_in_a, [&](const Vec3& point) {
    return a.solidParts().winding.closedAt(point).value_or(1) != 0;
  });
}

bool partsWhenLifted(const octoblisk::Surface& solid, const octoblisk::Surface& part,
                     const Pose& part_in_solid, const Vec3& up, double depth) {
  const ClusteredOctree* const caps = solid.solidParts().winding.capTree();
  if (caps && distance(*caps, part.tree(), part_in_solid, {.upper_bound = depth}).found()) return false;
  constexpr double kSlope = 0.3;
  const Vec3 across = up.unitOrthogonal(), along = up.cross(across);
  for (const Vec3& direction : {up, Vec3(up + kSlope * across), Vec3(up - kSlope * across),
                                Vec3(up + kSlope * along), Vec3(up - kSlope * along)}) {
    const Pose lifted{part_in_solid.rotation, part_in_solid.translation + depth * direction.normalized()};
    if (!collide(solid.tree(), part.tree(), lifted) && !areNestedIfCapped(solid, part, lifted)) return true;
  }
  return false;
}

}  // namespace octoblisk::demos
