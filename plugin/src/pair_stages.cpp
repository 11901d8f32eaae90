#include "pair_stages.h"

namespace octoblisk::detail {

namespace {

using Cache = btHashedOverlappingPairCache;

// A coarse pair has no algorithm; its room for a user's number, 0 at first, tells whether it is tight.
enum class Verdict { undecided, apart, tight };
Verdict verdictOf(const btBroadphasePair& pair) { return static_cast<Verdict>(pair.m_internalTmpValue); }
bool isDecided(const btBroadphasePair& pair) { return verdictOf(pair) != Verdict::undecided; }
bool isTight(const btBroadphasePair& pair) { return verdictOf(pair) == Verdict::tight; }
void setTight(btBroadphasePair& pair, bool tight) {
  pair.m_internalTmpValue = static_cast<int>(tight ? Verdict::tight : Verdict::apart);
}

}  // namespace

CoarsePairs::CoarsePairs(TightPairs& tight) : tight_(tight) { tight.coarse_ = this; }

void CoarsePairs::refine(int depth, btDispatcher* dispatcher) {
  holders_.forget();
  btBroadphasePairArray& pairs = getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    btBroadphasePair& pair = pairs[i];
    btBroadphaseProxy *a = pair.m_pProxy0, *b = pair.m_pProxy1;
    if (isDecided(pair) && dispatcher && bothSleep(*a, *b, *dispatcher)) continue;
    const bool was_tight = isTight(pair),
               tight = !clustersDecide(*a, *b, holders_) || clustersMeet(*a, *b, depth, holders_);
    setTight(pair, tight);
    if (tight == was_tight) continue;
    if (tight) {
      tight_.promote(a, b);
    } else {
      tight_.Cache::removeOverlappingPair(a, b, dispatcher);
    }
  }
}

bool CoarsePairs::needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  return tight_.needsBroadphaseCollision(a, b);
}

btBroadphasePair* CoarsePairs::addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  btBroadphasePair* pair = Cache::addOverlappingPair(a, b);
  if (pair && !isDecided(*pair) && !clustersDecide(*a, *b)) {
    setTight(*pair, true);
    tight_.promote(a, b);
  }
  return pair;
}

btBroadphasePair* CoarsePairs::addTight(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  btBroadphasePair* pair = Cache::addOverlappingPair(a, b);
  if (!pair) return nullptr;
  setTight(*pair, true);
  return tight_.promote(a, b);
}

void* CoarsePairs::removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b,
                                         btDispatcher* dispatcher) {
  tight_.Cache::removeOverlappingPair(a, b, dispatcher);
  return Cache::removeOverlappingPair(a, b, dispatcher);
}

bool TightPairs::needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  return promoting_ || Cache::needsBroadphaseCollision(a, b);  // a coarse pair has passed the filter
}

btBroadphasePair* TightPairs::addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  return coarse_->addTight(a, b);
}

void* TightPairs::removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b,
                                        btDispatcher* dispatcher) {
  coarse_->Cache::removeOverlappingPair(a, b, dispatcher);
  return Cache::removeOverlappingPair(a, b, dispatcher);
}

btBroadphasePair* TightPairs::promote(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  promoting_ = true;
  btBroadphasePair* pair = Cache::addOverlappingPair(a, b);
  promoting_ = false;
  return pair;
}

}  // namespace octoblisk::detail
