#include "octoblisk_bullet/time_of_impact.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <cassert>
#include <stdexcept>

#include "octoblisk_bullet/step_motion.h"
#include "part_sweep.h"

namespace octoblisk {

using namespace detail;

namespace {

TriangleId triangleId(const BodyPart& part, std::uint32_t triangle) {
  return part.ours ? part.ours->triangleId(triangle) : TriangleId{-1, -1};
}

StepImpact stepImpactOf(const TimeOfImpact& impact, const BodyPart& a, const BodyPart& b) {
  const Clearance& clearance = impact.clearance;
  return {btScalar(impact.fraction),
          btScalar(clearance.distance - a.margin() - b.margin()),
          toBullet(clearance.point_on_a),
          toBullet(clearance.point_on_b),
          triangleId(a, clearance.triangle_a),
          triangleId(b, clearance.triangle_b),
          a.shape,
          b.shape,
          impact.converged};
}

}  // namespace

std::optional<StepImpact> timeOfImpact(const btCollisionObject& a, const btCollisionObject& b, btScalar dt,
                                       btScalar tolerance, const SweepOptions& options) {
  if (!a.getCollisionShape() || !b.getCollisionShape()) {
    throw std::invalid_argument("timeOfImpact: a body has no shape");
  }
  assert(options.until > 0.0);
  const MovingBody body_a{*a.getCollisionShape(), stepMotion(a, dt)},
      body_b{*b.getCollisionShape(), stepMotion(b, dt)};
  std::optional<StepImpact> first;
  SweepOptions until_first = options;
  bool compared = false;
  forEachPartPair(body_a, body_b, [&](const BodyPart& part_a, const BodyPart& part_b) {
    compared = true;
    if (until_first.until == 0.0) return;  // two parts are near at the start
    const double within = sweepTolerance(body_a, part_a, body_b, part_b, tolerance);
    const auto impact = sweepParts(part_a, part_b, within, until_first);
    if (!impact) return;
    until_first.until = impact->fraction;
    first = stepImpactOf(*impact, part_a, part_b);
  });
  if (!compared) {
    throw std::invalid_argument(
        "timeOfImpact: the bodies have no part of ClusteredOctreeShape and another part that is one or "
        "convex");
  }
  return first;
}

}  // namespace octoblisk
