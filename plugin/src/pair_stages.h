// The pairs of ClusteredOctreeBroadphase: those that Bullet sees, and those that clusters separate.
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "cluster_test.h"
#include "travelled_distances.h"

namespace octoblisk::detail {

/// The pairs whose boxes overlap, but whose bodies are separated by clusters. They have passed the user's
/// filter.
class SeparatedPairs final : public btHashedOverlappingPairCache {
 public:
  void beginStep() { travelled_.beginStep(); }

  /// Whether clusters still separate a pair of this cache. Tests them only if the bodies may have met since
  /// the last test.
  bool staySeparated(btBroadphasePair& pair, ClusterTest& clusters);

  /// Call this before the proxy is deleted.
  void forget(const btBroadphaseProxy& proxy) { travelled_.forget(proxy); }

  bool needsBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }

 private:
  TravelledDistances travelled_;
};

/// The pairs whose boxes overlap, except those that clusters separate. The inner broadphase fills this cache.
/// Bullet and the user read it. A pair is in one cache only. Therefore a pair to which the cluster test does
/// not apply costs as much as in Bullet, and pairs keep Bullet's order until one is separated.
class TightPairs final : public btHashedOverlappingPairCache {
 public:
  /// `depth`: the depth of the clusters.
  explicit TightPairs(int depth) : clusters_(depth) {}

  /// The number of pairs that clusters separate.
  int separated() const { return separated_.getNumOverlappingPairs(); }

  /// Tests the clusters at the current transforms. Skips pairs with a contact that still holds, and pairs
  /// that have moved too little to meet since a test. While both bodies of a pair sleep, the pair stays where
  /// it is.
  void refine(btDispatcher* dispatcher);

  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  /// A new pair that clusters separate is returned, but is not in the array.
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  /// Users call this after a body got another shape.
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

 private:
  btBroadphasePair* addFiltered(btBroadphaseProxy* a, btBroadphaseProxy* b, bool tested);
  void promote(btDispatcher* dispatcher);
  void demote(btDispatcher* dispatcher);

  bool any_tested_ = false;   // whether any pair of the array is tested by refine
  bool is_filtered_ = false;  // whether the pair being added has passed the filter
  SeparatedPairs separated_;
  ClusterTest clusters_;       // a step is one refine
  btManifoldArray manifolds_;  // a buffer for the manifolds of a pair
};

/// Both stages: from overlapping boxes to the pairs that Bullet sees.
struct PairStages {
  explicit PairStages(int depth) : tight(depth) {}

  TightPairs tight;
  btDbvtBroadphase boxes{&tight};
};

}  // namespace octoblisk::detail
