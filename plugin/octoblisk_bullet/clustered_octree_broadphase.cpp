#include "octoblisk_bullet/clustered_octree_broadphase.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include <algorithm>

#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/near_bodies.h"

namespace octoblisk {
namespace {

double clusterVolume(const btCollisionShape& shape, int depth) {
  double volume = 0.0;
  if (const auto* clusters = dynamic_cast<const ClusteredOctreeShape*>(&shape)) {
    for (const Obb& box : clusters->tree().boxes(depth)) volume += box.volume();
  } else if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i) {
      volume += clusterVolume(*compound.getChildShape(i), depth);
    }
  }
  return volume;
}

}  // namespace

BroadphaseStatistics ClusteredOctreeBroadphase::statistics() const {
  BroadphaseStatistics statistics{coarsePairs(), tightPairs()};
  for (const btDbvtProxy* first : inner_.m_stageRoots) {
    for (const btDbvtProxy* proxy = first; proxy; proxy = proxy->links[1]) {
      const auto* body = static_cast<const btCollisionObject*>(proxy->m_clientObject);
      if (!body || !body->getCollisionShape() || !holdsClusters(*body->getCollisionShape())) continue;
      statistics.box_volume += fromBullet(proxy->m_aabbMax - proxy->m_aabbMin).prod();
      statistics.cluster_volume += clusterVolume(*body->getCollisionShape(), std::max(depth_, 0));
    }
  }
  return statistics;
}

void ClusteredOctreeBroadphase::calculateOverlappingPairs(btDispatcher* dispatcher) {
  inner_.calculateOverlappingPairs(dispatcher);
  coarse_.refine(depth_, dispatcher);
}

btBroadphaseProxy* ClusteredOctreeBroadphase::createProxy(const btVector3& aabb_min,
                                                          const btVector3& aabb_max, int shape_type,
                                                          void* client, int group, int mask,
                                                          btDispatcher* dispatcher) {
  return inner_.createProxy(aabb_min, aabb_max, shape_type, client, group, mask, dispatcher);
}

void ClusteredOctreeBroadphase::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  inner_.destroyProxy(proxy, dispatcher);
}

void ClusteredOctreeBroadphase::setAabb(btBroadphaseProxy* proxy, const btVector3& aabb_min,
                                        const btVector3& aabb_max, btDispatcher* dispatcher) {
  inner_.setAabb(proxy, aabb_min, aabb_max, dispatcher);
}

void ClusteredOctreeBroadphase::getAabb(btBroadphaseProxy* proxy, btVector3& aabb_min,
                                        btVector3& aabb_max) const {
  inner_.getAabb(proxy, aabb_min, aabb_max);
}

void ClusteredOctreeBroadphase::rayTest(const btVector3& from, const btVector3& to,
                                        btBroadphaseRayCallback& callback, const btVector3& aabb_min,
                                        const btVector3& aabb_max) {
  inner_.rayTest(from, to, callback, aabb_min, aabb_max);
}

void ClusteredOctreeBroadphase::aabbTest(const btVector3& aabb_min, const btVector3& aabb_max,
                                         btBroadphaseAabbCallback& callback) {
  inner_.aabbTest(aabb_min, aabb_max, callback);
}

void ClusteredOctreeBroadphase::getBroadphaseAabb(btVector3& aabb_min, btVector3& aabb_max) const {
  inner_.getBroadphaseAabb(aabb_min, aabb_max);
}

}  // namespace octoblisk
