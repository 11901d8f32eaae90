#include "pair_stages.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace octoblisk::detail {

namespace {

using Cache = btHashedOverlappingPairCache;

// btBroadphasePair::m_internalTmpValue, which Bullet leaves at 0, belongs to these classes. It is not 0 in
// the tight pairs that refine tests.
bool isTested(const btBroadphasePair& pair) { return pair.m_internalTmpValue != 0; }

/// The value if refine has not tested the pair since it was added or cleaned. No margin has its bits.
constexpr int kUntested = -1;

/// The value after a test. It changes with the margins, because contacts made with other margins prove
/// nothing.
int testedWith(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto margin = [](const btBroadphaseProxy& proxy) {
    return static_cast<const btCollisionObject*>(proxy.m_clientObject)->getCollisionShape()->getMargin();
  };
  return std::bit_cast<int>(float(margin(a) + margin(b))) | 1;
}

/// The motion that a test of clusters allows for, as a fraction of the smaller body. A larger value makes
/// tests fail more often. A smaller one makes them expire sooner.
constexpr double kAhead = 1.0 / 64.0;

double sizeOf(const btBroadphaseProxy& proxy) {
  return 0.5 * double((proxy.m_aabbMax - proxy.m_aabbMin).length());
}

/// The comparison of the inner broadphase.
bool boxesOverlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return Intersect(static_cast<const btDbvtProxy&>(a).leaf->volume,
                   static_cast<const btDbvtProxy&>(b).leaf->volume);
}

bool areKeptApart(const btBroadphaseProxy& a, const btBroadphaseProxy& b, int depth, HolderCache& holders) {
  return clustersDecide(a, b, holders) && !clustersMeet(a, b, depth, holders);
}

}  // namespace

void TightPairs::refine(btDispatcher* dispatcher) {
  holders_.forget();
  travelled_.beginStep();
  promote(dispatcher);
  if (any_tested_) demote(dispatcher);
}

/// Whether clusters keep a pair apart. Tests them if the bodies may have met since the last test. The pair's
/// field, read as a double, holds the sum of the bodies' travelled distances up to which they are proved to
/// be apart; null: nothing is proved.
bool TightPairs::stayApart(btBroadphasePair& pair) {
  const btBroadphaseProxy &a = *pair.m_pProxy0, &b = *pair.m_pProxy1;
  void*& proved = pair.m_internalInfo1;
  if (!clustersDecide(a, b, holders_)) return false;
  const double travelled = travelled_.of(a) + travelled_.of(b);
  if (proved && travelled <= std::bit_cast<double>(proved)) return true;
  const double ahead = kAhead * std::min(sizeOf(a), sizeOf(b));
  const bool is_proved = std::isfinite(travelled) && !clustersMeet(a, b, depth_, holders_, ahead);
  proved = is_proved ? std::bit_cast<void*>(std::nextafter(travelled + ahead, 0.0)) : nullptr;
  return is_proved || !clustersMeet(a, b, depth_, holders_);
}

void TightPairs::promote(btDispatcher* dispatcher) {
  btBroadphasePairArray& pairs = apart_.getOverlappingPairArray();
  for (int i = 0; i < pairs.size();) {
    btBroadphaseProxy *a = pairs[i].m_pProxy0, *b = pairs[i].m_pProxy1;
    const bool overlap = boxesOverlap(*a, *b);
    if (overlap && (bothSleep(*a, *b, dispatcher) || stayApart(pairs[i]))) {
      ++i;
      continue;
    }
    apart_.removeOverlappingPair(a, b, dispatcher);  // the last pair takes its place
    if (overlap) addFiltered(a, b, true);
  }
}

void TightPairs::demote(btDispatcher* dispatcher) {
  btBroadphasePairArray& pairs = getOverlappingPairArray();
  any_tested_ = false;
  for (int i = 0; i < pairs.size(); ++i) {
    btBroadphasePair& pair = pairs[i];
    if (!isTested(pair)) continue;
    btBroadphaseProxy *a = pair.m_pProxy0, *b = pair.m_pProxy1;
    if (pair.m_internalTmpValue == kUntested && !clustersMayDecide(*a, *b)) {
      pair.m_internalTmpValue = 0;
      continue;
    }
    any_tested_ = true;
    if (bothSleep(*a, *b, dispatcher)) continue;
    const int tested = testedWith(*a, *b);
    if (pair.m_internalTmpValue == tested && aContactHolds(pair, manifolds_)) continue;
    pair.m_internalTmpValue = tested;
    if (!areKeptApart(*a, *b, depth_, holders_)) continue;
    Cache::removeOverlappingPair(a, b, dispatcher);
    // Bullet notices only some steps later that boxes no longer overlap.
    if (boxesOverlap(*a, *b)) apart_.addOverlappingPair(a, b);
    --i;  // the last pair took its place
  }
}

bool TightPairs::needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  return is_filtered_ || Cache::needsBroadphaseCollision(a, b);
}

btBroadphasePair* TightPairs::addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  if (!needsBroadphaseCollision(a, b)) return nullptr;
  // Most pairs are known: the inner broadphase adds all pairs of a body that has left its box.
  if (btBroadphasePair* const known = findPair(a, b)) return known;
  if (btBroadphasePair* const known = apart_.findPair(a, b)) return known;
  const bool tested = clustersMayDecide(*a, *b);
  if (tested && areKeptApart(*a, *b, depth_, holders_)) return apart_.addOverlappingPair(a, b);
  return addFiltered(a, b, tested);
}

btBroadphasePair* TightPairs::addFiltered(btBroadphaseProxy* a, btBroadphaseProxy* b, bool tested) {
  is_filtered_ = true;
  btBroadphasePair* const pair = Cache::addOverlappingPair(a, b);
  is_filtered_ = false;
  pair->m_internalTmpValue = tested ? kUntested : 0;
  any_tested_ |= tested;
  return pair;
}

void* TightPairs::removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b,
                                        btDispatcher* dispatcher) {
  apart_.removeOverlappingPair(a, b, dispatcher);
  return Cache::removeOverlappingPair(a, b, dispatcher);
}

void TightPairs::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  travelled_.forget(*proxy);
  apart_.removeOverlappingPairsContainingProxy(proxy, dispatcher);
  Cache::removeOverlappingPairsContainingProxy(proxy, dispatcher);
}

/// Reads no shape: Bullet also calls this for a body that it removes, whose shape may have been deleted.
void TightPairs::cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  Cache::cleanProxyFromPairs(proxy, dispatcher);
  btBroadphasePairArray& pairs = getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    if (pairs[i].m_pProxy0 != proxy && pairs[i].m_pProxy1 != proxy) continue;
    pairs[i].m_internalTmpValue = kUntested;
    any_tested_ = true;
  }
}

}  // namespace octoblisk::detail
