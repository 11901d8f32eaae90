// Corrects contacts for what Bullet's solver assumes about a step.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace octoblisk::detail {

/// Call this just before a step of length `time_step` is solved. Changes distances and restitutions of
/// contact points. Ignores links of multibodies.
/// - Bullet's solver moves the points of a body along straight lines. A point of a rolling body comes down
///   ahead of the contact along a curve, and does not reach the other body. The solver would stop it. So this
///   function increases the distance of a contact that does not touch yet by what the curves of its two
///   points add within the step.
/// - Bodies with restitution bounce once, in the step in which they touch, at the speed that the restitution
///   gives. Bullet's solver would reduce the speed after the bounce by the remaining distance of a contact
///   that is not touching yet, and would add a part of its depth.
void correctForStep(btPersistentManifold& manifold, btScalar time_step);

}  // namespace octoblisk::detail
