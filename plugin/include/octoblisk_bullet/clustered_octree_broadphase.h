// A broadphase that knows what our shapes are made of: one line to use, in place of btDbvtBroadphase.
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>

#include <memory>

namespace octoblisk {

namespace detail {
struct PairStages;
}  // namespace detail

/// What a ClusteredOctreeBroadphase holds. Volumes are in world units cubed.
struct BroadphaseStatistics {
  int coarse_pairs = 0;  ///< pairs of overlapping boxes, and some whose boxes have parted in the last steps
  int tight_pairs = 0;   ///< of these those that Bullet is told of
  /// Of the boxes, as Bullet has them, of all bodies with our shape, or with a compound that holds it.
  double box_volume = 0.0;
  /// Of the boxes of the clusters that stand for these bodies, not grown, summed; other children of the
  /// compounds are left out.
  double cluster_volume = 0.0;
};

/// Reports a pair with a ClusteredOctreeShape only where one of its clusters, or of a compound's child that
/// is ours, meets the other's box or clusters, grown so that no contact is lost: a body in the middle of a
/// ring, or between two blades, makes no pair, no algorithm and no island with it. All other pairs are
/// those of btDbvtBroadphase, at the same cost; ghosts and soft bodies meet our shape by their boxes, as
/// ever.
///
/// Bodies move to the last bit as with btDbvtBroadphase until clusters keep a pair apart: pairs have its
/// order. Then the order differs, and smaller islands sleep sooner. Bullet's solver depends on the order of
/// contacts, so bodies come to rest at places that differ a little, and piles that tumble part as they do by
/// rounding.
///
/// Clusters are asked as a pair is added, and again, at the transforms that the bodies have then, in each
/// calculateOverlappingPairs: a world's step calls it, and computeOverlappingPairs. A pair of two bodies that
/// sleep, and that the dispatcher leaves alone (needsCollision), stays as it is until one wakes, as all that
/// Bullet knows of it. A body that gets another shape needs the cache's cleanProxyFromPairs, as in Bullet:
/// without it, clusters have no say in pairs that it had with another kind of shape. Built with assertions,
/// the first step with our shape asserts that its algorithms are registered (register.h). Clients must be
/// btCollisionObject, as in every world, or null.
class ClusteredOctreeBroadphase final : public btBroadphaseInterface {
 public:
  /// Some thousands of boxes at most, of which few are ever looked at.
  static constexpr int kDefaultDepth = 4;

  /// `depth`: how far below the root's box, which is 0, the clusters lie that stand for a shape: the deeper
  /// the tighter, and the costlier for bodies that are close; octoblisk/clusters_near.h.
  explicit ClusteredOctreeBroadphase(int depth = kDefaultDepth);
  ~ClusteredOctreeBroadphase() override;
  ClusteredOctreeBroadphase(const ClusteredOctreeBroadphase&) = delete;
  ClusteredOctreeBroadphase& operator=(const ClusteredOctreeBroadphase&) = delete;

  int depth() const { return depth_; }

  /// Of the present moment. Counts are at hand; the volumes are summed over all boxes.
  BroadphaseStatistics statistics() const;
  int coarsePairs() const;
  int tightPairs() const;

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
  bool isAnswered(btDispatcher* dispatcher);

  int depth_;
  bool has_our_shape_ = false;  // a body of it was added
  bool is_answered_ = false;    // by the dispatcher
  std::unique_ptr<detail::PairStages> stages_;
};

}  // namespace octoblisk
