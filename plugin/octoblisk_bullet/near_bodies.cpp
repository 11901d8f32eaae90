#include "octoblisk_bullet/near_bodies.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "octoblisk/clusters_near.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"

namespace octoblisk {
namespace {

const btCollisionObject* clientOf(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject);
}

const ClusteredOctreeShape* asClusters(const btCollisionShape& shape) {
  if (shape.getShapeType() != FAST_CONCAVE_MESH_PROXYTYPE) return nullptr;
  return dynamic_cast<const ClusteredOctreeShape*>(&shape);
}

/// A body, or a child of a compound.
struct Part {
  const ClusteredOctreeShape* clusters;  ///< none: the box stands for it
  btTransform in_world;
  Aabb box;  ///< in the world

  /// How far beyond its triangles it still has contacts.
  double reach() const {
    return double(clusters->getMargin()) +
           double(clusters->getContactBreakingThreshold(gContactBreakingThreshold));
  }
};

Part partOf(const btCollisionShape& shape, const btTransform& in_world) {
  btVector3 min, max;
  shape.getAabb(in_world, min, max);
  const Vec3 near = Vec3::Constant(double(gContactBreakingThreshold));  // as Bullet grows a body's box
  return {asClusters(shape), in_world, {fromBullet(min) - near, fromBullet(max) + near}};
}

/// Calls meets(part) for the parts until it is true.
template <typename Meets>
bool anyPart(const btCollisionShape& shape, const btTransform& in_world, const Meets& meets) {
  if (!shape.isCompound()) return meets(partOf(shape, in_world));
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (anyPart(*compound.getChildShape(i), in_world * compound.getChildTransform(i), meets)) return true;
  }
  return false;
}

template <typename Meets>
bool anyPart(const btBroadphaseProxy& proxy, const Meets& meets) {
  const btCollisionObject& body = *clientOf(proxy);
  if (holdsClusters(*body.getCollisionShape())) {
    return anyPart(*body.getCollisionShape(), body.getWorldTransform(), meets);
  }
  return meets(Part{nullptr, body.getWorldTransform(),
                    Aabb{fromBullet(proxy.m_aabbMin), fromBullet(proxy.m_aabbMax)}});
}

bool clustersMeetBox(const Part& part, const Aabb& box, int depth) {
  const Obb in_part =
      fromBullet(part.in_world).inverse() * Obb{box.center(), Mat3::Identity(), box.halfExtents()};
  return clustersNear(part.clusters->tree(), in_part, part.reach(), depth);
}

bool meet(const Part& a, const Part& b, int depth) {
  // Some boxes are infinite, a plane's say; what they have in common is not.
  const Aabb common{a.box.min.cwiseMax(b.box.min), a.box.max.cwiseMin(b.box.max)};
  if (!(common.min.array() <= common.max.array()).all()) return false;
  if (a.clusters && b.clusters) {
    const Pose b_in_a = fromBullet(a.in_world).inverse() * fromBullet(b.in_world);
    return clustersNear(a.clusters->tree(), b.clusters->tree(), b_in_a, a.reach() + b.reach(), depth);
  }
  if (a.clusters) return clustersMeetBox(a, common, depth);
  if (b.clusters) return clustersMeetBox(b, common, depth);
  return true;
}

bool isBody(const btCollisionObject* object) {
  constexpr int kKinds = btCollisionObject::CO_COLLISION_OBJECT | btCollisionObject::CO_RIGID_BODY |
                         btCollisionObject::CO_FEATHERSTONE_LINK;
  return object && (object->getInternalType() & kKinds) != 0 && object->getCollisionShape();
}

}  // namespace

bool holdsClusters(const btCollisionShape& shape) {
  if (!shape.isCompound()) return asClusters(shape) != nullptr;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (holdsClusters(*compound.getChildShape(i))) return true;
  }
  return false;
}

bool clustersDecide(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const btCollisionObject *body_a = clientOf(a), *body_b = clientOf(b);
  return isBody(body_a) && isBody(body_b) &&
         (holdsClusters(*body_a->getCollisionShape()) || holdsClusters(*body_b->getCollisionShape()));
}

bool bothSleep(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const btCollisionObject *body_a = clientOf(a), *body_b = clientOf(b);
  return isBody(body_a) && isBody(body_b) && !body_a->isActive() && !body_b->isActive();
}

bool clustersMeet(const btBroadphaseProxy& a, const btBroadphaseProxy& b, int depth) {
  return anyPart(a, [&](const Part& part_a) {
    return anyPart(b, [&](const Part& part_b) { return meet(part_a, part_b, depth); });
  });
}

}  // namespace octoblisk
