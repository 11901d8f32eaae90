// Bullet's motion of a body within a step, as a Motion of the core.
#pragma once

#include <LinearMath/btTransform.h>

#include "octoblisk/motion.h"

class btCollisionObject;

namespace octoblisk {

/// The motion that ends at the result of btTransformUtil::integrateTransform, to the rounding of btScalar.
/// The origin moves straight by velocity times `dt` (> 0), and the body turns about it at constant speed. The
/// angle is angular velocity times `dt` up to 45° and less beyond, as in Bullet. The rotation of `from` is
/// made orthonormal to double precision.
Motion stepMotion(const btTransform& from, const btVector3& linear_velocity,
                  const btVector3& angular_velocity, btScalar dt);

/// The motion of a body from its current pose: by the velocities of a btRigidBody, or by the interpolation
/// velocities of any other object. Static bodies stay; a btCollisionObject is static by default. Kinematic
/// bodies continue with their current velocities.
Motion stepMotion(const btCollisionObject& body, btScalar dt);

}  // namespace octoblisk
