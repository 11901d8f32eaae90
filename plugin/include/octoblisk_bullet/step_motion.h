// How Bullet moves a body within a step, as a motion of the core.
#pragma once

#include <LinearMath/btTransform.h>

#include "octoblisk/motion.h"

class btCollisionObject;

namespace octoblisk {

/// The motion whose end is btTransformUtil::integrateTransform's, to the rounding of btScalar: the origin
/// goes straight by velocity times `dt` (> 0), the body turns about it at constant speed. The turn is angular
/// velocity times `dt` up to 45° and less than that beyond, as Bullet's is. The rotation of `from` is made
/// orthonormal to double precision.
Motion stepMotion(const btTransform& from, const btVector3& linear_velocity,
                  const btVector3& angular_velocity, btScalar dt);

/// That of a body from where it is: of a btRigidBody by its velocities, of any other by its interpolation
/// velocities. Static bodies, as a btCollisionObject is by default, stay; kinematic ones go on with the
/// velocities that they have.
Motion stepMotion(const btCollisionObject& body, btScalar dt);

}  // namespace octoblisk
