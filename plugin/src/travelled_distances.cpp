#include "travelled_distances.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <cmath>
#include <limits>

#include "octoblisk/body_bounds.h"
#include "our_shape.h"
#include "proxy_body.h"
#include "shape_bounds.h"

namespace octoblisk::detail {
namespace {

/// Not below the exact sum.
double sumAbove(double a, double b) {
  return b == 0.0 ? a : std::nextafter(a + b, std::numeric_limits<double>::infinity());
}

}  // namespace

TravelledDistances::State TravelledDistances::stateOf(const btBroadphaseProxy& proxy) {
  const btCollisionObject& object = *bodyOf(proxy);
  const btCollisionShape& shape = *object.getCollisionShape();
  State state;
  state.in_world = fromBullet(object.getWorldTransform());
  state.box = shapeBounds(shape, object.getWorldTransform());
  state.box.extend(fromBullet(proxy.m_aabbMin));
  state.box.extend(fromBullet(proxy.m_aabbMax));
  state.reach = double(gContactBreakingThreshold);
  if (const ClusteredOctreeShape* const ours = asOurShape(shape)) {
    state.tree = ours->sharedTree();
    state.is_solid = ours->isSolid();
    state.reach += contactReach(*ours);
  }
  return state;
}

double TravelledDistances::distance(const State& from, const State& to) {
  const Vec3 of_min = to.box.min - from.box.min, of_max = to.box.max - from.box.max;
  const double of_box = of_min.cwiseAbs().cwiseMax(of_max.cwiseAbs()).norm();
  if (from.tree == to.tree && from.is_solid == to.is_solid && from.reach == to.reach) {
    return to.tree ? BodyBounds(*to.tree).displacement(from.in_world, to.in_world) : of_box;
  }
  return of_box + 2.0 * (from.box.halfExtents().norm() + to.box.halfExtents().norm());
}

double TravelledDistances::of(const btBroadphaseProxy& proxy) {
  const btCollisionObject& object = *bodyOf(proxy);
  if (object.getCollisionShape()->isCompound()) return std::numeric_limits<double>::infinity();
  const auto known = bodies_.find(&proxy);
  const bool is_new = known == bodies_.end();
  if (!is_new && known->second.step == step_) return known->second.travelled;
  State now = stateOf(proxy);
  if (!now.in_world.isFinite() || now.box.isEmpty()) return std::numeric_limits<double>::infinity();
  Body& body = is_new ? bodies_[&proxy] : known->second;
  if (!is_new) body.travelled = sumAbove(body.travelled, distance(body.state, now));
  body.state = std::move(now);
  body.step = step_;
  return body.travelled;
}

}  // namespace octoblisk::detail
