// The two pair caches of ClusteredOctreeBroadphase: pairs of boxes, and of these the ones that Bullet sees.
#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "near_bodies.h"

namespace octoblisk::detail {

class TightPairs;

/// The pairs whose boxes overlap, as the inner broadphase keeps them. A pair is tight, and in the other cache
/// too, at once where clusters have no say (near_bodies.h), else once refine says so; what is removed here is
/// removed there first.
class CoarsePairs final : public btHashedOverlappingPairCache {
 public:
  explicit CoarsePairs(TightPairs& tight);

  /// Makes each pair tight, or no longer, by the clusters of the given depth at the present transforms. A
  /// pair of which both sleep stays what it is while the dispatcher leaves it alone: until one wakes.
  void refine(int depth, btDispatcher* dispatcher);

  /// The user's filter, asked once, on insertion.
  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;

 private:
  friend class TightPairs;
  btBroadphasePair* addTight(btBroadphaseProxy* a, btBroadphaseProxy* b);

  TightPairs& tight_;
  ClusterHolders holders_;  // for the time of a refine
};

/// The pairs that Bullet dispatches and the user sees, with the user's callbacks. Always some of the coarse
/// ones: what a user adds or removes here is added or removed there.
class TightPairs final : public btHashedOverlappingPairCache {
 public:
  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;

 private:
  friend class CoarsePairs;
  btBroadphasePair* promote(btBroadphaseProxy* a, btBroadphaseProxy* b);

  CoarsePairs* coarse_ = nullptr;
  bool promoting_ = false;
};

/// From overlapping boxes to the pairs that Bullet sees.
struct PairStages {
  TightPairs tight;
  CoarsePairs coarse{tight};
  btDbvtBroadphase boxes{&coarse};
};

}  // namespace octoblisk::detail
