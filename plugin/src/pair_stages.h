// The pairs of ClusteredOctreeBroadphase: those that Bullet sees, and those that clusters keep from it.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "near_bodies.h"

namespace octoblisk::detail {

/// Pairs that have passed the user's filter.
class ApartPairs final : public btHashedOverlappingPairCache {
 public:
  bool needsBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

/// The pairs whose boxes overlap, without those that clusters keep apart: the cache of the inner broadphase,
/// of Bullet and of the user. A pair is in one cache only. So a pair in which clusters have no say
/// (near_bodies.h) costs what it costs in Bullet, and pairs have Bullet's order until one is kept apart.
class TightPairs final : public btHashedOverlappingPairCache {
 public:
  /// `depth` of the clusters.
  explicit TightPairs(int depth) : depth_(depth) {}

  /// How many pairs clusters keep apart.
  int apart() const { return apart_.getNumOverlappingPairs(); }

  /// Asks the clusters at the present transforms. A pair with a contact that holds need not be asked. While
  /// both bodies of a pair sleep, the pair stays where it is.
  void refine(btDispatcher* dispatcher);

  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  /// A new pair that clusters keep apart is not in the array, but is returned.
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  /// Users call it for a body that got another shape.
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

 private:
  btBroadphasePair* addFiltered(btBroadphaseProxy* a, btBroadphaseProxy* b, bool asked);
  void promote(btDispatcher* dispatcher);
  void demote(btDispatcher* dispatcher);

  const int depth_;
  bool any_asked_ = false;    // some pair of the array is
  bool is_filtered_ = false;  // the pair that is added
  ApartPairs apart_;
  ClusterHolders holders_;     // since the last refine began
  btManifoldArray manifolds_;  // room for those of a pair
};

/// From overlapping boxes to the pairs that Bullet sees.
struct PairStages {
  explicit PairStages(int depth) : tight(depth) {}

  TightPairs tight;
  btDbvtBroadphase boxes{&tight};
};

}  // namespace octoblisk::detail
