#include "octoblisk_bullet/time_of_impact.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <stdexcept>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/step_motion.h"

namespace octoblisk {

using namespace detail;

namespace {

const ClusteredOctreeShape& ourShapeOf(const btCollisionObject& body) {
  const auto* shape = dynamic_cast<const ClusteredOctreeShape*>(body.getCollisionShape());
  if (!shape) throw std::invalid_argument("timeOfImpact: a body's shape is no ClusteredOctreeShape");
  return *shape;
}

/// The lengths that enter the pose of a body along its way.
double sizeOf(const ClusteredOctree& tree, const Motion& motion) {
  const Aabb& bounds = tree.mesh().bounds();
  return bounds.center().norm() + bounds.halfExtents().norm() + motion.from().translation.norm() +
         motion.advance().norm();
}

}  // namespace

double sweepTolerance(const ClusteredOctreeShape& a, const Motion& a_in_world, const ClusteredOctreeShape& b,
                      const Motion& b_in_world, btScalar tolerance) {
  if (tolerance < 0) {
    tolerance = std::min(a.getContactBreakingThreshold(gContactBreakingThreshold),
                         b.getContactBreakingThreshold(gContactBreakingThreshold)) /
                4;
  }
  constexpr double kRounding = 4.0 * double(SIMD_EPSILON);
  const double least = kRounding * (sizeOf(a.tree(), a_in_world) + sizeOf(b.tree(), b_in_world));
  return std::max(double(tolerance), least) + double(a.getMargin()) + double(b.getMargin());
}

std::optional<StepImpact> timeOfImpact(const btCollisionObject& a, const btCollisionObject& b, btScalar dt,
                                       btScalar tolerance, const SweepOptions& options) {
  const ClusteredOctreeShape &shape_a = ourShapeOf(a), &shape_b = ourShapeOf(b);
  const Motion motion_a = stepMotion(a, dt), motion_b = stepMotion(b, dt);
  const auto impact = sweep(shape_a.tree(), shape_b.tree(), motion_a, motion_b,
                            sweepTolerance(shape_a, motion_a, shape_b, motion_b, tolerance), options);
  if (!impact) return std::nullopt;
  const Clearance& clearance = impact->clearance;
  const Pose a_in_world = motion_a.at(impact->fraction);
  return StepImpact{btScalar(impact->fraction),
                    btScalar(clearance.distance) - shape_a.getMargin() - shape_b.getMargin(),
                    toBullet(a_in_world * clearance.point_on_a),
                    toBullet(a_in_world * clearance.point_on_b),
                    shape_a.triangleId(clearance.triangle_a),
                    shape_b.triangleId(clearance.triangle_b),
                    impact->converged};
}

}  // namespace octoblisk
