#include "octoblisk_bullet/kinematic_body.h"

#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace octoblisk {

void addKinematicBody(btDynamicsWorld& world, btRigidBody& body) {
  body.setCollisionFlags((body.getCollisionFlags() & ~btCollisionObject::CF_STATIC_OBJECT) |
                         btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);  // Bullet makes no contacts between two sleeping bodies
  world.addRigidBody(&body, btBroadphaseProxy::KinematicFilter,
                     btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::KinematicFilter);
}

}  // namespace octoblisk
