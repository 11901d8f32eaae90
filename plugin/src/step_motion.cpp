#include "octoblisk_bullet/step_motion.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "octoblisk_bullet/convert.h"
#include "orthonormal_pose.h"

namespace octoblisk {

namespace {

/// The angle, in radians, by which Bullet turns a body with an angular speed. Beyond the threshold of a step,
/// Bullet uses the sine and cosine of half the threshold, scales the sine by the ratio of the speeds, and
/// normalises the quaternion. The result is less than half a turn at any speed.
double turnOf(double speed, double dt) {
  const double half = 0.5 * std::min(speed * dt, double(ANGULAR_MOTION_THRESHOLD));
  if (half <= 0.0) return 0.0;
  return 2.0 * std::atan2(0.5 * speed * dt * std::sin(half) / half, std::cos(half));
}

}  // namespace

Motion stepMotion(const btTransform& from, const btVector3& linear_velocity,
                  const btVector3& angular_velocity, btScalar dt) {
  assert(dt > 0);
  const Pose pose = detail::orthonormalPose(from);
  const Vec3 velocity = fromBullet(angular_velocity);
  const double speed = velocity.norm();
  const Vec3 turn = speed > 0.0 ? Vec3(velocity * (turnOf(speed, double(dt)) / speed)) : Vec3(Vec3::Zero());
  return Motion::about(pose, pose.translation, turn, fromBullet(linear_velocity) * double(dt));
}

Motion stepMotion(const btCollisionObject& body, btScalar dt) {
  const btVector3 none(0, 0, 0);
  const btTransform& from = body.getWorldTransform();
  if (body.isStaticObject()) return stepMotion(from, none, none, dt);
  if (const btRigidBody* rigid = btRigidBody::upcast(&body)) {
    return stepMotion(from, rigid->getLinearVelocity(), rigid->getAngularVelocity(), dt);
  }
  return stepMotion(from, body.getInterpolationLinearVelocity(), body.getInterpolationAngularVelocity(), dt);
}

}  // namespace octoblisk
