// When and how fast bodies bounce.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace octoblisk::detail {

/// Corrects the contacts of bodies with restitution just before a step of length `time_step` is solved, so
/// that bodies bounce once, in the step in which they touch, at the speed that the restitution gives. Without
/// it, Bullet's solver reduces the speed after the bounce by the remaining distance of a contact that is not
/// touching yet, and adds a part of its depth. Changes distances and restitutions of contact points. Ignores
/// links of multibodies.
void bounceAtTouch(btPersistentManifold& manifold, btScalar time_step);

}  // namespace octoblisk::detail
