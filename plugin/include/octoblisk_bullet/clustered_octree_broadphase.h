// A broadphase that looks into ClusteredOctreeShape. Use it in place of btDbvtBroadphase.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>

#include <memory>

namespace octoblisk {

namespace detail {
struct PairStages;
}  // namespace detail

/// Reports a pair with a ClusteredOctreeShape only if a cluster of the shape meets the other body's box or
/// clusters, grown so that no contact is lost. A ClusteredOctreeShape in a compound counts too. A body in the
/// middle of a ring, or between two blades, therefore makes no pair, no algorithm and no island with it. All
/// other pairs are those of btDbvtBroadphase, at the same cost. Ghosts and soft bodies meet the shape by
/// their boxes, as in Bullet.
///
/// Until the clusters reject a pair for the first time, pairs have the order of btDbvtBroadphase, and bodies
/// move identically to the last bit. Then the order differs, and islands are smaller and sleep sooner.
/// Bullet's solver depends on the order of contacts. So bodies come to rest at slightly different places, and
/// tumbling piles diverge as they do under rounding errors.
///
/// The broadphase tests the clusters when a pair is added, and again in each calculateOverlappingPairs, at
/// the bodies' current transforms. A world's step and computeOverlappingPairs call it. The broadphase does
/// not test a pair of sleeping bodies while the dispatcher ignores the pair (needsCollision).
///
/// If a body's shape is replaced, call the cache's cleanProxyFromPairs, as in Bullet. Otherwise the clusters
/// ignore the pairs that the body had with the old kind of shape. In builds with assertions, the first step
/// with a ClusteredOctreeShape asserts that its algorithms are registered (register.h). Clients must be
/// btCollisionObject, as in every world, or null.
class ClusteredOctreeBroadphase final : public btBroadphaseInterface {
 public:
  /// A few thousand boxes at most; queries visit few of them.
  static constexpr int kDefaultDepth = 4;

  /// `depth`: the depth of the clusters that represent a shape; the root's box has depth 0. Deeper clusters
  /// are tighter, but cost more for bodies that are close.
  explicit ClusteredOctreeBroadphase(int depth = kDefaultDepth);
  ~ClusteredOctreeBroadphase() override;
  ClusteredOctreeBroadphase(const ClusteredOctreeBroadphase&) = delete;
  ClusteredOctreeBroadphase& operator=(const ClusteredOctreeBroadphase&) = delete;

  /// The number of pairs whose boxes overlap, and some whose boxes separated in the last steps. Bullet sees
  /// only the pairs in getOverlappingPairCache().
  int coarsePairs() const;

  void calculateOverlappingPairs(btDispatcher* dispatcher) override;
  btOverlappingPairCache* getOverlappingPairCache() override;
  const btOverlappingPairCache* getOverlappingPairCache() const override;

  btBroadphaseProxy* createProxy(const btVector3& aabb_min, const btVector3& aabb_max, int shape_type,
                                 void* client, int group, int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& aabb_min, const btVector3& aabb_max,
               btDispatcher* dispatcher) override;
  void getAabb(btBroadphaseProxy* proxy, btVector3& aabb_min, btVector3& aabb_max) const override;
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback,
               const btVector3& aabb_min = btVector3(0, 0, 0),
               const btVector3& aabb_max = btVector3(0, 0, 0)) override;
  void aabbTest(const btVector3& aabb_min, const btVector3& aabb_max,
                btBroadphaseAabbCallback& callback) override;
  void getBroadphaseAabb(btVector3& aabb_min, btVector3& aabb_max) const override;
  void resetPool(btDispatcher* dispatcher) override;
  void printStats() override;

 private:
  bool hasAlgorithms(btDispatcher* dispatcher);

  bool has_our_shape_ = false;   // whether a body with ClusteredOctreeShape was added
  bool has_algorithms_ = false;  // whether the dispatcher has the shape's algorithms
  std::unique_ptr<detail::PairStages> stages_;
};

}  // namespace octoblisk
