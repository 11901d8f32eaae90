#include "step_start.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btTransformUtil.h>

namespace octoblisk::detail {

btTransform stepStart(const btCollisionObject& body, btScalar dt) {
  if ((body.isStaticObject() && !body.isKinematicObject()) || !body.isActive())
    return body.getWorldTransform();
  btTransform start;
  // The user may have changed the velocities since the step. The interpolation velocities are still those
  // that moved the body.
  btTransformUtil::integrateTransform(body.getWorldTransform(), -body.getInterpolationLinearVelocity(),
                                      -body.getInterpolationAngularVelocity(), dt, start);
  return start;
}

}  // namespace octoblisk::detail
