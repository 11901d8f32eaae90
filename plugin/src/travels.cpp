#include "travels.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <limits>

#include "body_parts.h"
#include "octoblisk/motion.h"

namespace octoblisk::detail {

Travels::State Travels::stateOf(const btBroadphaseProxy& proxy) {
  const auto& object = *static_cast<const btCollisionObject*>(proxy.m_clientObject);
  const btCollisionShape& shape = *object.getCollisionShape();
  btVector3 min, max;
  shape.getAabb(object.getWorldTransform(), min, max);
  State state;
  state.in_world = fromBullet(object.getWorldTransform());
  state.box = {fromBullet(min), fromBullet(max)};
  state.box.extend(fromBullet(proxy.m_aabbMin));
  state.box.extend(fromBullet(proxy.m_aabbMax));
  state.reach = double(gContactBreakingThreshold);
  if (const ClusteredOctreeShape* const clusters = asClusters(shape)) {
    state.tree = clusters->sharedTree();
    state.is_solid = clusters->isSolid();
    state.reach += double(clusters->getMargin()) +
                   double(clusters->getContactBreakingThreshold(gContactBreakingThreshold));
  }
  return state;
}

double Travels::way(const State& from, const State& to) {
  const Vec3 of_min = to.box.min - from.box.min, of_max = to.box.max - from.box.max;
  const double of_box = of_min.cwiseAbs().cwiseMax(of_max.cwiseAbs()).norm();
  if (from.tree == to.tree && from.is_solid == to.is_solid && from.reach == to.reach) {
    return to.tree ? BodyBounds(*to.tree).displacement(from.in_world, to.in_world) : of_box;
  }
  return of_box + 2.0 * (from.box.halfExtents().norm() + to.box.halfExtents().norm());
}

double Travels::of(const btBroadphaseProxy& proxy) {
  const auto& object = *static_cast<const btCollisionObject*>(proxy.m_clientObject);
  if (object.getCollisionShape()->isCompound()) return std::numeric_limits<double>::infinity();
  const auto [known, is_new] = bodies_.try_emplace(&proxy);
  Body& body = known->second;
  if (body.look == look_) return body.travelled;
  State now = stateOf(proxy);
  if (!is_new) body.travelled += way(body.state, now);
  body.state = std::move(now);
  body.look = look_;
  return body.travelled;
}

}  // namespace octoblisk::detail
