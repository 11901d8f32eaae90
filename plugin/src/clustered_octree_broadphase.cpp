#include "octoblisk_bullet/clustered_octree_broadphase.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <cassert>

#include "octoblisk_bullet/register.h"
#include "our_shape.h"
#include "pair_stages.h"

namespace octoblisk {

using namespace detail;

ClusteredOctreeBroadphase::ClusteredOctreeBroadphase(int depth)
    : stages_(std::make_unique<PairStages>(depth)) {}

ClusteredOctreeBroadphase::~ClusteredOctreeBroadphase() = default;

int ClusteredOctreeBroadphase::coarsePairs() const {
  return stages_->tight.getNumOverlappingPairs() + stages_->tight.separated();
}

btOverlappingPairCache* ClusteredOctreeBroadphase::getOverlappingPairCache() { return &stages_->tight; }
const btOverlappingPairCache* ClusteredOctreeBroadphase::getOverlappingPairCache() const {
  return &stages_->tight;
}

/// Whether the dispatcher handles our shape; tested once such a shape exists.
bool ClusteredOctreeBroadphase::hasAlgorithms(btDispatcher* dispatcher) {
  auto* const known = dynamic_cast<btCollisionDispatcher*>(dispatcher);
  if (!has_our_shape_ || has_algorithms_ || !known) return true;
  has_algorithms_ = isRegistered(known);
  return has_algorithms_;
}

void ClusteredOctreeBroadphase::calculateOverlappingPairs(btDispatcher* dispatcher) {
  assert(hasAlgorithms(dispatcher) &&
         "registerAlgorithm was not called on this dispatcher: bodies fall through");
  stages_->boxes.calculateOverlappingPairs(dispatcher);
  stages_->tight.refine(dispatcher);
}

btBroadphaseProxy* ClusteredOctreeBroadphase::createProxy(const btVector3& aabb_min,
                                                          const btVector3& aabb_max, int shape_type,
                                                          void* client, int group, int mask,
                                                          btDispatcher* dispatcher) {
  const auto* const body = static_cast<const btCollisionObject*>(client);
  has_our_shape_ |= body && body->getCollisionShape() && holdsOurShape(*body->getCollisionShape());
  return stages_->boxes.createProxy(aabb_min, aabb_max, shape_type, client, group, mask, dispatcher);
}

void ClusteredOctreeBroadphase::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  stages_->boxes.destroyProxy(proxy, dispatcher);
}

void ClusteredOctreeBroadphase::setAabb(btBroadphaseProxy* proxy, const btVector3& aabb_min,
                                        const btVector3& aabb_max, btDispatcher* dispatcher) {
  stages_->boxes.setAabb(proxy, aabb_min, aabb_max, dispatcher);
}

void ClusteredOctreeBroadphase::getAabb(btBroadphaseProxy* proxy, btVector3& aabb_min,
                                        btVector3& aabb_max) const {
  stages_->boxes.getAabb(proxy, aabb_min, aabb_max);
}

void ClusteredOctreeBroadphase::rayTest(const btVector3& from, const btVector3& to,
                                        btBroadphaseRayCallback& callback, const btVector3& aabb_min,
                                        const btVector3& aabb_max) {
  stages_->boxes.rayTest(from, to, callback, aabb_min, aabb_max);
}

void ClusteredOctreeBroadphase::aabbTest(const btVector3& aabb_min, const btVector3& aabb_max,
                                         btBroadphaseAabbCallback& callback) {
  stages_->boxes.aabbTest(aabb_min, aabb_max, callback);
}

void ClusteredOctreeBroadphase::getBroadphaseAabb(btVector3& aabb_min, btVector3& aabb_max) const {
  stages_->boxes.getBroadphaseAabb(aabb_min, aabb_max);
}

void ClusteredOctreeBroadphase::resetPool(btDispatcher* dispatcher) { stages_->boxes.resetPool(dispatcher); }

void ClusteredOctreeBroadphase::printStats() { stages_->boxes.printStats(); }

}  // namespace octoblisk
