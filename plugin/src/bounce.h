// When and how fast bodies bounce.
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace octoblisk::detail {

/// Corrects the contacts of bodies with restitution, just before a step of length `time_step` is solved, so
/// that bodies bounce once, in the step in which they touch, at the speed that the restitution gives.
/// Bullet's solver takes the distance of a contact ahead of touch off the speed after the bounce, and adds a
/// part of its depth. Writes distances and restitutions of contact points. Leaves links of multibodies alone.
void bounceAtTouch(btPersistentManifold& manifold, btScalar time_step);

}  // namespace octoblisk::detail
