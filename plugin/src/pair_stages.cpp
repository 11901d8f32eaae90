#include "pair_stages.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "proxy_body.h"

namespace octoblisk::detail {

namespace {

using Cache = btHashedOverlappingPairCache;

// Bullet leaves btBroadphasePair::m_internalTmpValue at 0. Here, it is not 0 in the tight pairs that refine
// tests.
bool isTested(const btBroadphasePair& pair) { return pair.m_internalTmpValue != 0; }

/// The value if refine has not tested the pair since it was added or cleaned. No margin has its bits.
constexpr int kUntested = -1;

/// The value after a test. It changes with the margins, because contacts made with other margins prove
/// nothing.
int testedWith(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto margin = [](const btBroadphaseProxy& proxy) {
    return bodyOf(proxy)->getCollisionShape()->getMargin();
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

/// Whether both bodies are inactive and the dispatcher, if any, ignores such a pair, as Bullet's does.
bool bothSleep(const btBroadphaseProxy& a, const btBroadphaseProxy& b, btDispatcher* dispatcher) {
  const btCollisionObject *body_a = bodyOf(a), *body_b = bodyOf(b);
  return dispatcher && isBody(body_a) && isBody(body_b) && !body_a->isActive() && !body_b->isActive() &&
         !dispatcher->needsCollision(body_a, body_b);
}

/// Whether a contact of the pair's last dispatch still holds at the current transforms, by the criterion of
/// its manifold. If so, the bodies are near each other, unless a shape has changed since. `manifolds` is a
/// buffer.
bool aContactHolds(const btBroadphasePair& pair, btManifoldArray& manifolds) {
  if (!pair.m_algorithm) return false;
  manifolds.resizeNoInitialize(0);
  pair.m_algorithm->getAllContactManifolds(manifolds);
  for (int m = 0; m < manifolds.size(); ++m) {
    const btPersistentManifold& manifold = *manifolds[m];
    const btTransform& a = manifold.getBody0()->getWorldTransform();
    const btTransform& b = manifold.getBody1()->getWorldTransform();
    const btScalar breaking = manifold.getContactBreakingThreshold();
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& point = manifold.getContactPoint(p);
      if ((a * point.m_localPointA).distance2(b * point.m_localPointB) <= breaking * breaking) return true;
    }
  }
  return false;
}

}  // namespace

/// The pair's field, read as a double, holds the sum of the bodies' travelled distances up to which they are
/// proved to be apart; null: nothing is proved.
bool SeparatedPairs::staySeparated(btBroadphasePair& pair, ClusterTest& clusters) {
  const btBroadphaseProxy &a = *pair.m_pProxy0, &b = *pair.m_pProxy1;
  void*& proved = pair.m_internalInfo1;
  if (!clusters.applies(a, b)) return false;
  const double travelled = travelled_.of(a) + travelled_.of(b);
  if (proved && travelled <= std::bit_cast<double>(proved)) return true;
  const double ahead = kAhead * std::min(sizeOf(a), sizeOf(b));
  const bool is_proved = std::isfinite(travelled) && clusters.separates(a, b, ahead);
  proved = is_proved ? std::bit_cast<void*>(std::nextafter(travelled + ahead, 0.0)) : nullptr;
  return is_proved || clusters.separates(a, b);
}

void TightPairs::refine(btDispatcher* dispatcher) {
  clusters_.beginStep();
  separated_.beginStep();
  promote(dispatcher);
  if (any_tested_) demote(dispatcher);
}

void TightPairs::promote(btDispatcher* dispatcher) {
  btBroadphasePairArray& pairs = separated_.getOverlappingPairArray();
  for (int i = 0; i < pairs.size();) {
    btBroadphaseProxy *a = pairs[i].m_pProxy0, *b = pairs[i].m_pProxy1;
    const bool overlap = boxesOverlap(*a, *b);
    if (overlap && (bothSleep(*a, *b, dispatcher) || separated_.staySeparated(pairs[i], clusters_))) {
      ++i;
      continue;
    }
    separated_.removeOverlappingPair(a, b, dispatcher);  // the last pair takes its place
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
    if (pair.m_internalTmpValue == kUntested && !ClusterTest::mayApply(*a, *b)) {
      pair.m_internalTmpValue = 0;
      continue;
    }
    any_tested_ = true;
    if (bothSleep(*a, *b, dispatcher)) continue;
    const int tested = testedWith(*a, *b);
    if (pair.m_internalTmpValue == tested && aContactHolds(pair, manifolds_)) continue;
    pair.m_internalTmpValue = tested;
    if (!clusters_.applies(*a, *b) || !clusters_.separates(*a, *b)) continue;
    Cache::removeOverlappingPair(a, b, dispatcher);
    // Bullet notices only some steps later that boxes no longer overlap.
    if (boxesOverlap(*a, *b)) separated_.addOverlappingPair(a, b);
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
  if (btBroadphasePair* const known = separated_.findPair(a, b)) return known;
  const bool tested = ClusterTest::mayApply(*a, *b);
  if (tested && clusters_.applies(*a, *b) && clusters_.separates(*a, *b))
    return separated_.addOverlappingPair(a, b);
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
  separated_.removeOverlappingPair(a, b, dispatcher);
  return Cache::removeOverlappingPair(a, b, dispatcher);
}

void TightPairs::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  separated_.forget(*proxy);
  separated_.removeOverlappingPairsContainingProxy(proxy, dispatcher);
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
