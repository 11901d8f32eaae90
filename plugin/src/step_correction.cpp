#include "step_correction.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

namespace octoblisk::detail {
namespace {

/// How a point of a body moves; not at all if the body is no rigid body.
struct PointMotion {
  btVector3 velocity = btVector3(0, 0, 0);
  btVector3 acceleration = btVector3(0, 0, 0);  ///< towards the axis of rotation

  PointMotion(const btCollisionObject* object, const btVector3& place) {
    const btRigidBody* const body = btRigidBody::upcast(object);
    if (!body) return;
    const btVector3 from_center = place - body->getCenterOfMassPosition();
    const btVector3& spin = body->getAngularVelocity();
    velocity = body->getVelocityInLocalPoint(from_center);
    acceleration = spin.cross(spin.cross(from_center));
  }
};

}  // namespace

void correctForStep(btPersistentManifold& manifold, btScalar time_step) {
  const auto isLink = [](const btCollisionObject* object) {
    return object->getInternalType() == btCollisionObject::CO_FEATHERSTONE_LINK;
  };
  if (isLink(manifold.getBody0()) || isLink(manifold.getBody1())) return;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    const bool is_ahead = point.getDistance() > 0, bounces = point.m_combinedRestitution > 0;
    if (!is_ahead && !bounces) continue;
    const PointMotion on_a(manifold.getBody0(), point.getPositionWorldOnA());
    const PointMotion on_b(manifold.getBody1(), point.getPositionWorldOnB());
    const btVector3& normal = point.m_normalWorldOnB;  // from B to A
    if (is_ahead) {
      const btScalar curving = normal.dot(on_a.acceleration - on_b.acceleration);
      point.setDistance(point.getDistance() +
                        btScalar(0.5) * std::max(curving, btScalar(0)) * time_step * time_step);
    }
    if (!bounces) continue;
    const btScalar approach = normal.dot(on_b.velocity - on_a.velocity);
    if (btFabs(point.getDistance()) < approach * time_step) {
      point.setDistance(0);  // the bodies touch within this step, or did within the last one
    } else if (is_ahead) {
      point.m_combinedRestitution = 0;
    }
  }
}

}  // namespace octoblisk::detail
