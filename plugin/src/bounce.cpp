#include "bounce.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace octoblisk::detail {
namespace {

/// The speed at which two rigid bodies approach each other at a contact.
btScalar approachSpeed(const btPersistentManifold& manifold, const btManifoldPoint& point) {
  const auto velocity = [](const btCollisionObject* object, const btVector3& place) {
    const btRigidBody* const body = btRigidBody::upcast(object);
    return body ? body->getVelocityInLocalPoint(place - body->getCenterOfMassPosition()) : btVector3(0, 0, 0);
  };
  return point.m_normalWorldOnB.dot(velocity(manifold.getBody1(), point.getPositionWorldOnB()) -
                                    velocity(manifold.getBody0(), point.getPositionWorldOnA()));
}

}  // namespace

void bounceAtTouch(btPersistentManifold& manifold, btScalar time_step) {
  const auto isLink = [](const btCollisionObject* object) {
    return object->getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK;
  };
  if (isLink(manifold.getBody0()) || isLink(manifold.getBody1())) return;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    if (!(point.m_combinedRestitution > 0)) continue;
    if (btFabs(point.getDistance()) < approachSpeed(manifold, point) * time_step) {
      point.setDistance(0);  // the bodies touch within this step, or did within the last one
    } else if (point.getDistance() > 0) {
      point.m_combinedRestitution = 0;
    }
  }
}

}  // namespace octoblisk::detail
