// Restores a body from one of Bullet's files.
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "octoblisk_bullet/restore.h"

namespace octoblisk {

namespace {

btVector3 read(const btVector3FloatData& saved) {
  btVector3 vector;
  vector.deSerializeFloat(saved);
  return vector;
}

btVector3 read(const btVector3DoubleData& saved) {
  btVector3 vector;
  vector.deSerializeDouble(saved);
  return vector;
}

/// 0 represents infinity, as in Bullet.
btScalar inverse(btScalar number) { return number == btScalar(0) ? btScalar(0) : btScalar(1) / number; }

template <typename Data>
void restore(const Data& saved, btRigidBody& body) {
  const auto& object = saved.m_collisionObjectData;
  const btVector3 inverse_inertia = read(saved.m_invInertiaLocal);
  body.setMassProps(
      inverse(btScalar(saved.m_inverseMass)),
      btVector3(inverse(inverse_inertia.x()), inverse(inverse_inertia.y()), inverse(inverse_inertia.z())));
  body.updateInertiaTensor();
  body.setGravity(read(saved.m_gravity_acceleration));
  if (object.m_contactStiffness != 0)  // it is 0 in a file of an older Bullet
    body.setContactStiffnessAndDamping(btScalar(object.m_contactStiffness),
                                       btScalar(object.m_contactDamping));
  body.setAnisotropicFriction(read(object.m_anisotropicFriction), object.m_hasAnisotropicFriction);
  body.setContactProcessingThreshold(btScalar(object.m_contactProcessingThreshold));
  body.setCollisionFlags(object.m_collisionFlags);
  body.setLinearFactor(read(saved.m_linearFactor));
  body.setAngularFactor(read(saved.m_angularFactor));
  body.setLinearVelocity(read(saved.m_linearVelocity));
  body.setAngularVelocity(read(saved.m_angularVelocity));
  body.setInterpolationWorldTransform(body.getWorldTransform());
  body.setInterpolationLinearVelocity(body.getLinearVelocity());
  body.setInterpolationAngularVelocity(body.getAngularVelocity());
  body.setDamping(btScalar(saved.m_linearDamping), btScalar(saved.m_angularDamping));
  body.setSleepingThresholds(btScalar(saved.m_linearSleepingThreshold),
                             btScalar(saved.m_angularSleepingThreshold));
  body.setFriction(btScalar(object.m_friction));
  body.setRollingFriction(btScalar(object.m_rollingFriction));
  body.setRestitution(btScalar(object.m_restitution));
  body.setCcdMotionThreshold(btScalar(object.m_ccdMotionThreshold));
  body.setCcdSweptSphereRadius(btScalar(object.m_ccdSweptSphereRadius));
  body.forceActivationState(object.m_activationState1);
  body.setDeactivationTime(btScalar(object.m_deactivationTime));
}

}  // namespace

void restoreBody(const btRigidBodyFloatData& saved, btRigidBody& body) { restore(saved, body); }
void restoreBody(const btRigidBodyDoubleData& saved, btRigidBody& body) { restore(saved, body); }

}  // namespace octoblisk
