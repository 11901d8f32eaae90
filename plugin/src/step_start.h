// Where a body was at the start of the last step.
#pragma once

#include <LinearMath/btTransform.h>

class btCollisionObject;

namespace octoblisk::detail {

/// The pose from which Bullet moved a body in its last step, which took `dt`: the inverse of that motion. The
/// current pose if the body is static or asleep. If Bullet's own clamping has shortened the motion, the pose is
/// farther back on its path.
btTransform stepStart(const btCollisionObject& body, btScalar dt);

}  // namespace octoblisk::detail
