#include "octoblisk_bullet/motion_clamping.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <LinearMath/btTransformUtil.h>

#include <algorithm>
#include <numeric>

#include "octoblisk/sweep.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/step_motion.h"
#include "octoblisk_bullet/time_of_impact.h"

namespace octoblisk {

using namespace detail;

namespace {

/// Where Bullet took the body from: it moves back as it moved.
btTransform startOf(const btRigidBody& body, btScalar dt) {
  btTransform start;
  btTransformUtil::integrateTransform(body.getWorldTransform(), -body.getLinearVelocity(),
                                      -body.getAngularVelocity(), dt, start);
  return start;
}

/// A box that holds the body all along its way, and what is as near to it as contacts are made.
Aabb sweptBox(const btCollisionObject& object, const ClusteredOctreeShape& shape, const Motion& motion,
              bool moves) {
  Aabb box;
  double reach = double(shape.getContactBreakingThreshold(gContactBreakingThreshold));
  if (moves) {
    box.extend(motion.from().translation);
    box.extend(motion.from().translation + motion.advance());
    reach += Hold(shape.tree()).distanceFromPoint(Vec3::Zero()) + double(shape.getMargin());
  } else {
    btVector3 low, high;
    shape.getAabb(object.getWorldTransform(), low, high);
    box.extend(fromBullet(low));
    box.extend(fromBullet(high));
  }
  return {box.min.array() - reach, box.max.array() + reach};
}

/// Whether the world makes contacts of the two that push them apart.
bool collide(btCollisionWorld& world, btCollisionObject& first, btCollisionObject& second) {
  return world.getPairCache()->needsBroadphaseCollision(first.getBroadphaseHandle(),
                                                        second.getBroadphaseHandle()) &&
         world.getDispatcher()->needsCollision(&first, &second) &&
         world.getDispatcher()->needsResponse(&first, &second);
}

/// The smaller of the two thresholds that are set; 0 where none is.
double motionThreshold(const btCollisionObject& first, const btCollisionObject& second) {
  const double of_first = double(first.getCcdMotionThreshold()),
               of_second = double(second.getCcdMotionThreshold());
  if (of_first <= 0.0 || of_second <= 0.0) return std::max(of_first, of_second);
  return std::min(of_first, of_second);
}

}  // namespace

void MotionClamping::collect(btCollisionWorld& world, btScalar dt) {
  movers_.clear();
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    btCollisionObject& object = *objects[i];
    const auto* shape = dynamic_cast<const ClusteredOctreeShape*>(object.getCollisionShape());
    if (!shape) continue;
    btRigidBody* body = btRigidBody::upcast(&object);
    if (object.isStaticOrKinematicObject() || !object.isActive()) body = nullptr;
    const btVector3 none(0, 0, 0);
    const Motion motion =
        body ? stepMotion(startOf(*body, dt), body->getLinearVelocity(), body->getAngularVelocity(), dt)
             : stepMotion(object.getWorldTransform(), none, none, dt);
    movers_.push_back({&object, shape, body, motion, sweptBox(object, *shape, motion, body != nullptr),
                       movers_.size(), 1.0});
  }
}

std::size_t MotionClamping::islandOf(std::size_t mover) const {
  while (movers_[mover].island != mover) mover = movers_[mover].island;
  return mover;
}

void MotionClamping::join(std::size_t first, std::size_t second) {
  const auto [low, high] = std::minmax({islandOf(first), islandOf(second)});  // by value
  movers_[high].island = low;
  movers_[low].fraction = std::min(movers_[low].fraction, movers_[high].fraction);
}

double MotionClamping::freeFraction(const Mover& first, const Mover& second) const {
  const double threshold = motionThreshold(*first.object, *second.object);
  if (threshold <= 0.0) return 1.0;
  const ClusteredOctree &a = first.shape->tree(), &b = second.shape->tree();
  const double length = relativeLengthBound(a, first.motion, b, second.motion);
  if (length <= threshold) return 1.0;
  const double tolerance = sweepTolerance(*first.shape, first.motion, *second.shape, second.motion);
  const auto impact = sweep(a, b, first.motion, second.motion, tolerance);
  if (!impact) return 1.0;
  return impact->fraction > 0.0 ? impact->fraction : threshold / length;
}

void MotionClamping::updateAction(btCollisionWorld* world, btScalar dt) {
  clamped_.clear();
  if (!(dt > 0)) return;
  collect(*world, dt);
  const auto clampable = [](const Mover& mover) { return mover.object->getCcdMotionThreshold() > 0; };
  if (std::ranges::none_of(movers_, clampable)) return;

  by_start_.resize(movers_.size());
  std::iota(by_start_.begin(), by_start_.end(), std::size_t{0});
  std::ranges::sort(by_start_, {}, [&](std::size_t i) { return std::pair(movers_[i].swept.min.x(), i); });
  for (std::size_t i = 0; i < by_start_.size(); ++i) {
    const Mover& first = movers_[by_start_[i]];
    for (std::size_t j = i + 1; j < by_start_.size(); ++j) {
      const Mover& second = movers_[by_start_[j]];
      if (second.swept.min.x() > first.swept.max.x()) break;
      if (!first.moved && !second.moved) continue;
      const bool apart = (first.swept.min.array() > second.swept.max.array()).any() ||
                         (second.swept.min.array() > first.swept.max.array()).any();
      if (apart || !collide(*world, *first.object, *second.object)) continue;
      if (first.moved && second.moved) join(by_start_[i], by_start_[j]);
      double& fraction = movers_[islandOf(by_start_[first.moved ? i : j])].fraction;
      fraction = std::min(fraction, freeFraction(first, second));
    }
  }

  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const double fraction = movers_[islandOf(i)].fraction;
    if (!movers_[i].moved || fraction >= 1.0) continue;
    movers_[i].moved->proceedToTransform(toBullet(movers_[i].motion.at(fraction)));
    clamped_.push_back({movers_[i].moved, btScalar(fraction)});
  }
}

}  // namespace octoblisk
