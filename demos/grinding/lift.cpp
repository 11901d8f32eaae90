#include "grinding/lift.h"

#include "octoblisk/collide.h"
#include "octoblisk/containment.h"

namespace octoblisk::demos {

bool mayBeNested(const SolidBoundary& a, const octoblisk::Surface& b, const Pose& b_in_a) {
  for (std::size_t k = 0; k < b.componentCount(); ++k) {
    if (a.locate(b_in_a * b.position(b.cornerOfComponent(k))) != PointLocation::outside) return true;
  }
  const octoblisk::Surface& surface = a.surface();
  for (std::size_t k = 0; b.isClosed() && k < surface.componentCount(); ++k) {
    if (locate(b, surface.position(surface.cornerOfComponent(k)), b_in_a) == PointLocation::inside)
      return true;
  }
  return false;
}

bool partsWhenLifted(const SolidBoundary& solid, const octoblisk::Surface& part, const Pose& part_in_solid,
                     const Vec3& up, double depth) {
  constexpr double kSlope = 0.3;
  const Vec3 across = up.unitOrthogonal(), along = up.cross(across);
  for (const Vec3& direction : {up, Vec3(up + kSlope * across), Vec3(up - kSlope * across),
                                Vec3(up + kSlope * along), Vec3(up - kSlope * along)}) {
    const Pose lifted{part_in_solid.rotation, part_in_solid.translation + depth * direction.normalized()};
    if (!collide(solid.surface().tree(), part.tree(), lifted) && !mayBeNested(solid, part, lifted))
      return true;
  }
  return false;
}

}  // namespace octoblisk::demos
