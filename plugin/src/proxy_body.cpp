#include "proxy_body.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include "shape_bounds.h"

namespace octoblisk::detail {

const btCollisionObject* bodyOf(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

bool isBody(const btCollisionObject* object) {
  constexpr int kKinds = btCollisionObject::CO_COLLISION_OBJECT | btCollisionObject::CO_RIGID_BODY |
                         btCollisionObject::CO_FEATHERSTONE_LINK;
  return object && (object->getInternalType() & kKinds) != 0 && object->getCollisionShape();
}

Aabb boxOf(const btBroadphaseProxy& proxy) {
  const btCollisionObject& body = *bodyOf(proxy);
  Aabb box = shapeBounds(*body.getCollisionShape(), body.getWorldTransform());
  box.extend(fromBullet(proxy.m_aabbMin));
  box.extend(fromBullet(proxy.m_aabbMax));
  return box;
}

}  // namespace octoblisk::detail
