// The pairs of ClusteredOctreeBroadphase: those that Bullet sees, and those that clusters keep apart.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "near_bodies.h"
#include "travelled_distances.h"

namespace octoblisk::detail {

/// Pairs that have passed the user's filter.
class ApartPairs final : public btHashedOverlappingPairCache {
 public:
  bool needsBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

/// The pairs whose boxes overlap, except those that clusters keep apart. The inner broadphase fills this
/// cache. Bullet and the user read it. A pair is in one cache only. Therefore a pair about which clusters do
/// not decide (near_bodies.h) costs as much as in Bullet, and pairs keep Bullet's order until one is kept
/// apart.
class TightPairs final : public btHashedOverlappingPairCache {
 public:
  /// `depth`: the depth of the clusters.
  explicit TightPairs(int depth) : depth_(depth) {}

  /// The number of pairs that clusters keep apart.
  int apart() const { return apart_.getNumOverlappingPairs(); }

  /// Tests the clusters at the current transforms. Skips pairs with a contact that still holds, and pairs
  /// that have moved too little to meet since a test. While both bodies of a pair sleep, the pair stays where
  /// it is.
  void refine(btDispatcher* dispatcher);

  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  /// A new pair that clusters keep apart is returned, but is not in the array.
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  /// Users call this after a body got another shape.
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

 private:
  btBroadphasePair* addFiltered(btBroadphaseProxy* a, btBroadphaseProxy* b, bool tested);
  bool stayApart(btBroadphasePair& pair);
  void promote(btDispatcher* dispatcher);
  void demote(btDispatcher* dispatcher);

  const int depth_;
  bool any_tested_ = false;   // whether any pair of the array is tested by refine
  bool is_filtered_ = false;  // whether the pair being added has passed the filter
  ApartPairs apart_;
  HolderCache holders_;           // valid since the last refine began
  TravelledDistances travelled_;  // a step is one refine
  btManifoldArray manifolds_;     // a buffer for the manifolds of a pair
};

/// Both stages: from overlapping boxes to the pairs that Bullet sees.
struct PairStages {
  explicit PairStages(int depth) : tight(depth) {}

  TightPairs tight;
  btDbvtBroadphase boxes{&tight};
};

}  // namespace octoblisk::detail
