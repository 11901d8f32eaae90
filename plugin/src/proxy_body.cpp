#include "proxy_body.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace octoblisk::detail {

const btCollisionObject* bodyOf(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

bool isBody(const btCollisionObject* object) {
  constexpr int kKinds = btCollisionObject::CO_COLLISION_OBJECT | btCollisionObject::CO_RIGID_BODY |
                         btCollisionObject::CO_FEATHERSTONE_LINK;
  return object && (object->getInternalType() & kKinds) != 0 && object->getCollisionShape();
}

}  // namespace octoblisk::detail
