#include "octoblisk_bullet/motion_clamping.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <numeric>

#include "octoblisk_bullet/step_motion.h"
#include "part_sweep.h"
#include "shape_bounds.h"
#include "step_start.h"

namespace octoblisk {

using namespace detail;

namespace {

/// No point of the shape, margin included, is farther than this from its origin.
double farthestFromOrigin(const btCollisionShape& shape) {
  if (const ClusteredOctreeShape* ours = asOurShape(shape)) {
    return BodyBounds(ours->tree()).distanceFromPoint(Vec3::Zero()) + double(ours->getMargin());
  }
  return shapeBounds(shape).farthestFromOrigin();
}

/// A box that contains the body on its whole motion, grown by the contact breaking threshold.
Aabb sweptBox(const btCollisionObject& object, const Motion& motion, bool moves) {
  const btCollisionShape& shape = *object.getCollisionShape();
  Aabb box;
  double reach = double(shape.getContactBreakingThreshold(gContactBreakingThreshold));
  if (moves) {
    box.extend(motion.from().translation);
    box.extend(motion.from().translation + motion.advance());
    reach += farthestFromOrigin(shape);
  } else {
    box = shapeBounds(shape, object.getWorldTransform());
  }
  return box.grown(reach);
}

/// The velocity before an impulse was added. A contact may have stopped the impulse, or a part of it.
btVector3 without(const btVector3& impulse, const btVector3& velocity) {
  const btScalar squared = impulse.length2();
  if (!(squared > 0)) return velocity;
  return velocity - std::clamp(velocity.dot(impulse) / squared, btScalar(0), btScalar(1)) * impulse;
}

/// The body, if Bullet has moved it by its velocities over the whole step; else null. If Bullet's own
/// clamping has moved a body back, the start of its motion is unknown.
btRigidBody* movedBody(btCollisionObject& object) {
  if (object.isStaticOrKinematicObject() || !object.isActive() || object.getHitFraction() < 1) return nullptr;
  return btRigidBody::upcast(&object);
}

/// Whether the world makes contacts that push the two apart.
bool collide(btCollisionWorld& world, btCollisionObject& first, btCollisionObject& second) {
  return world.getPairCache()->needsBroadphaseCollision(first.getBroadphaseHandle(),
                                                        second.getBroadphaseHandle()) &&
         world.getDispatcher()->needsCollision(&first, &second) &&
         world.getDispatcher()->needsResponse(&first, &second);
}

/// The smaller of the thresholds that are set; 0 if none is.
double motionThreshold(const btCollisionObject& first, const btCollisionObject& second) {
  const double of_first = double(first.getCcdMotionThreshold()),
               of_second = double(second.getCcdMotionThreshold());
  if (of_first <= 0.0 || of_second <= 0.0) return std::max(of_first, of_second);
  return std::min(of_first, of_second);
}

/// Whether a threshold is set, and a body has a part of our shape.
bool mayClamp(const btCollisionWorld& world) {
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  bool has_threshold = false, has_ours = false;
  for (int i = 0; i < objects.size() && !(has_threshold && has_ours); ++i) {
    has_threshold = has_threshold || objects[i]->getCcdMotionThreshold() > 0;
    const btCollisionShape* shape = objects[i]->getCollisionShape();
    has_ours = has_ours || (shape && holdsOurShape(*shape));
  }
  return has_threshold && has_ours;
}

}  // namespace

void MotionClamping::collect(btCollisionWorld& world, btScalar dt) {
  movers_.clear();
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) {
    btCollisionObject& object = *objects[i];
    const btCollisionShape* shape = object.getCollisionShape();
    if (!shape || !hasPart(*shape)) continue;
    btRigidBody* body = movedBody(object);
    const btVector3 none(0, 0, 0);
    const Motion motion = body ? stepMotion(stepStart(*body, dt), body->getInterpolationLinearVelocity(),
                                            body->getInterpolationAngularVelocity(), dt)
                               : stepMotion(object.getWorldTransform(), none, none, dt);
    const Aabb swept = sweptBox(object, motion, body != nullptr);
    if (!swept.min.allFinite() || !swept.max.allFinite()) continue;
    movers_.push_back({&object, holdsOurShape(*shape), body, motion, swept, movers_.size(), 1.0});
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

double MotionClamping::freeFraction(const Mover& first, const Mover& second, double until) const {
  const double threshold = motionThreshold(*first.object, *second.object);
  if (threshold <= 0.0) return until;
  const MovingBody a{*first.object->getCollisionShape(), first.motion},
      b{*second.object->getCollisionShape(), second.motion};
  forEachPartPair(a, b, [&](const BodyPart& part_a, const BodyPart& part_b) {
    const double length =
        relativeLengthBound(part_a.bounds(), part_a.in_world, part_b.bounds(), part_b.in_world);
    if (length <= threshold) return;
    const auto impact = sweepParts(part_a, part_b, sweepTolerance(a, part_a, b, part_b), {.until = until});
    if (!impact) return;
    until = std::min(until, impact->fraction > 0.0 ? impact->fraction : threshold / length);
  });
  return until;
}

void MotionClamping::updateAction(btCollisionWorld* world, btScalar dt) {
  clamped_.clear();
  if (!(dt > 0)) return;
  if (!mayClamp(*world)) return;
  collect(*world, dt);

  by_start_.resize(movers_.size());
  std::iota(by_start_.begin(), by_start_.end(), std::size_t{0});
  std::ranges::sort(by_start_, {}, [&](std::size_t i) { return std::pair(movers_[i].swept.min.x(), i); });
  for (std::size_t i = 0; i < by_start_.size(); ++i) {
    const Mover& first = movers_[by_start_[i]];
    for (std::size_t j = i + 1; j < by_start_.size(); ++j) {
      const Mover& second = movers_[by_start_[j]];
      if (second.swept.min.x() > first.swept.max.x()) break;
      if (!(first.moved || second.moved) || !(first.ours || second.ours)) continue;
      if (!first.swept.meets(second.swept) || !collide(*world, *first.object, *second.object)) continue;
      if (first.moved && second.moved) join(by_start_[i], by_start_[j]);
      double& fraction = movers_[islandOf(by_start_[first.moved ? i : j])].fraction;
      fraction = freeFraction(first, second, fraction);
    }
  }

  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const double fraction = movers_[islandOf(i)].fraction;
    btRigidBody* const body = movers_[i].moved;
    if (!body || fraction >= 1.0) continue;
    const btVector3 moved_by = body->getInterpolationLinearVelocity(),
                    turned_by = body->getInterpolationAngularVelocity();
    const Motion& motion = movers_[i].motion;
    body->proceedToTransform(toBullet(motion.at(fraction)));
    // Bullet draws the body by these velocities. They must lead back to the start of the step, which contacts
    // may need. A fast spin turns the body by less than its speed says.
    const double spin = double(turned_by.length() * dt);
    body->setInterpolationLinearVelocity(btScalar(fraction) * moved_by);
    body->setInterpolationAngularVelocity(btScalar(spin > 0.0 ? fraction * motion.angle() / spin : 0.0) *
                                          turned_by);
    // Forces have acted for the whole step, but the body has moved for a part of it.
    const btScalar left = btScalar(1.0 - fraction) * dt;
    body->setLinearVelocity(
        without(left * body->getInvMass() * body->getTotalForce(), body->getLinearVelocity()));
    body->setAngularVelocity(without(left * (body->getInvInertiaTensorWorld() * body->getTotalTorque()),
                                     body->getAngularVelocity()));
    clamped_.push_back({body, btScalar(fraction)});
  }
}

}  // namespace octoblisk
