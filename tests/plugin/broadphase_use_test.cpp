// Uses ClusteredOctreeBroadphase like other code of Bullet and its users: filters, masks, ghosts, and pairs
// that a user removes or adds.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "plugin/broadphase_worlds.h"
#include "plugin/shape_over.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::shapeOf;
using testing::StockWorld;
using testing::TightWorld;

TEST(Broadphase, theFilterIsAskedOnInsertionAlone) {
  struct Filter final : btOverlapFilterCallback {
    mutable int asked = 0;
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      ++asked;  // and masks are ignored
      return static_cast<btCollisionObject*>(a->m_clientObject)->getUserIndex() +
                 static_cast<btCollisionObject*>(b->m_clientObject)->getUserIndex() !=
             4;
    }
  };
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  const auto run = [&](auto& world) {
    Filter filter;
    world.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
    btCollisionObject& ring = world.add(*torus, at(0, 0, 0), 1, 0);
    btCollisionObject& first = world.add(sphere, at(2, 0, 0), 1, 0);
    btCollisionObject& second = world.add(sphere, at(2.1, 0, 0), 1, 0);
    for (int i = 0; i < 10; ++i) {  // in and out of the tube, within the inner broadphase's box
      first.setWorldTransform(at(i % 2 == 0 ? 2 : 0, 0, 0));
      world.world.performDiscreteCollisionDetection();
    }
    second.setWorldTransform(at(2, 0, 0));
    first.setWorldTransform(at(2, 0, 0));
    world.world.performDiscreteCollisionDetection();
    EXPECT_TRUE(world.has(ring, first));
    EXPECT_FALSE(world.has(ring, second));  // 1 + 3
    EXPECT_TRUE(world.has(first, second));
    EXPECT_EQ(world.broadphase.getOverlappingPairCache()->getOverlapFilterCallback(), &filter);
    world.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
    return filter.asked;
  };
  TightWorld tight;
  StockWorld stock;
  EXPECT_EQ(run(tight), run(stock));
}

TEST(Broadphase, masksCountWithoutAFilter) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  TightWorld tight;
  tight.add(*torus, at(0, 0, 0), 1, 2);
  tight.add(sphere, at(2, 0, 0), 2, 1);
  tight.add(sphere, at(-2, 0, 0), 4, 1);
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.pairs(), 1);
}

TEST(Broadphase, ghostsGetPairsByTheirBoxes) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  btGhostPairCallback callback;
  btPairCachingGhostObject ghost;
  ghost.setCollisionShape(&sphere);
  ghost.setWorldTransform(at(0, 0, 0));
  TightWorld tight;
  tight.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&callback);
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  tight.world.addCollisionObject(&ghost);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);  // at once, as with btDbvtBroadphase
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  EXPECT_EQ(ghost.getOverlappingPairCache()->getNumOverlappingPairs(), 1);
  ring.setWorldTransform(at(50, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
  ring.setWorldTransform(at(0, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  tight.world.removeCollisionObject(&ring);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
}

TEST(Broadphase, whatAUserRemovesWhileIteratingIsGone) {
  struct RemoveEverySecond final : btOverlapCallback {
    int seen = 0;
    bool processOverlap(btBroadphasePair&) override { return ++seen % 2 == 0; }
  };
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  TightWorld tight;
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  for (int i = 0; i < 8; ++i) tight.add(sphere, at(2 * std::cos(0.785 * i), 2 * std::sin(0.785 * i), 0));
  tight.world.performDiscreteCollisionDetection();
  btOverlappingPairCache& cache = *tight.broadphase.getOverlappingPairCache();
  const int all = tight.pairs();
  ASSERT_GE(all, 8);
  RemoveEverySecond remove;
  cache.processAllOverlappingPairs(&remove, &tight.dispatcher);
  EXPECT_EQ(remove.seen, all);
  EXPECT_EQ(tight.pairs(), all - all / 2);
  EXPECT_EQ(tight.broadphase.coarsePairs(), tight.pairs());
  tight.world.performDiscreteCollisionDetection();  // no object has left its box, so Bullet makes no new
                                                    // pairs either
  EXPECT_EQ(tight.pairs(), all - all / 2);

  cache.sortOverlappingPairs(&tight.dispatcher);
  EXPECT_EQ(tight.pairs(), all - all / 2);
  btBroadphaseProxy* proxy = ring.getBroadphaseHandle();
  cache.cleanProxyFromPairs(proxy, &tight.dispatcher);
  for (int i = 0; i < tight.pairs(); ++i) {
    const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
    const bool is_of_ring = pair.m_pProxy0 == proxy || pair.m_pProxy1 == proxy;
    EXPECT_NE(pair.m_algorithm == nullptr, !is_of_ring);
  }
  btBroadphaseProxy* other = tight.objects.back()->getBroadphaseHandle();
  cache.removeOverlappingPairsContainingProxy(proxy, &tight.dispatcher);
  EXPECT_EQ(cache.findPair(proxy, other), nullptr);
  EXPECT_NE(cache.addOverlappingPair(proxy, other), nullptr);
  tight.world.performDiscreteCollisionDetection();
  EXPECT_NE(cache.findPair(proxy, other), nullptr);
}

/// Against the rule (docs/bullet.md), but Bullet's broadphases survive it. The deleted shapes lose the
/// pointers to their virtual functions, so that using them fails.
TEST(Broadphase, bodiesAreRemovedAfterTheirShapesWereDeleted) {
  const auto tree = treeOver(testing::torus(2, 0.5, 24, 12));
  alignas(ClusteredOctreeShape) std::array<std::byte, sizeof(ClusteredOctreeShape)> of_ring;
  alignas(btSphereShape) std::array<std::byte, sizeof(btSphereShape)> of_ball;
  auto* const ring = ::new (of_ring.data()) ClusteredOctreeShape(tree);
  auto* const ball = ::new (of_ball.data()) btSphereShape(btScalar(0.5));
  TightWorld tight;
  tight.add(*ring, at(0, 0, 0));
  tight.add(*ball, at(2, 0, 0));
  tight.add(*ball, at(2.2, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  ASSERT_EQ(tight.pairs(), 3);
  ring->~ClusteredOctreeShape();
  ball->~btSphereShape();
  std::fill_n(of_ring.begin(), sizeof(void*), std::byte{0xff});
  std::fill_n(of_ball.begin(), sizeof(void*), std::byte{0xff});
  while (tight.world.getNumCollisionObjects() > 0)
    tight.world.removeCollisionObject(tight.world.getCollisionObjectArray()[0]);
  EXPECT_EQ(tight.pairs(), 0);
}

TEST(Broadphase, aDispatcherThatLooksAtSleepersSeesThemMeet) {
  struct Sleepless final : btCollisionDispatcher {
    using btCollisionDispatcher::btCollisionDispatcher;
    bool needsCollision(const btCollisionObject*, const btCollisionObject*) override { return true; }
  };
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  btDefaultCollisionConfiguration configuration;
  Sleepless dispatcher(&configuration);
  registerAlgorithm(&dispatcher);
  ClusteredOctreeBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  btCollisionObject ring, ball;
  ring.setCollisionShape(torus.get());
  ball.setCollisionShape(&sphere);
  for (btCollisionObject* object : {&ring, &ball}) {
    object->forceActivationState(ISLAND_SLEEPING);
    world.addCollisionObject(object);
  }
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(broadphase.coarsePairs(), 1);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  ball.setWorldTransform(at(1.2, 0, 0));
  world.performDiscreteCollisionDetection();
  ASSERT_GT(dispatcher.getNumManifolds(), 0);
  EXPECT_GT(dispatcher.getManifoldByIndexInternal(0)->getNumContacts(), 0);
}

TEST(Broadphase, aSleeperMovedUnknownToBulletIsMetWhereItIs) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  const auto contactsAfterTheMove = [&](auto& world) {
    world.world.setForceUpdateAllAabbs(false);
    world.add(*torus, at(0, 0, 0));
    btCollisionObject& ball = world.add(sphere, at(0, 0, 0));
    ball.forceActivationState(ISLAND_SLEEPING);
    world.world.performDiscreteCollisionDetection();
    ball.setWorldTransform(at(1.2, 0, 0));  // without updateSingleAabb
    world.world.performDiscreteCollisionDetection();
    return testing::manifoldPoints(world.dispatcher).size();
  };
  StockWorld stock;
  TightWorld tight;
  const std::size_t expected = contactsAfterTheMove(stock);
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(contactsAfterTheMove(tight), expected);
}

TEST(Broadphase, whatALargeCompoundHoldsIsAskedAnew) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  btBoxShape box(btVector3(1, 1, 1));
  btSphereShape sphere(btScalar(0.5));
  btCompoundShape wall;
  for (int i = 0; i < 40; ++i) wall.addChildShape(at(3 * (i % 2 == 0 ? -1 - i / 2 : 1 + i / 2), 0, 0), &box);
  TightWorld tight;
  btCollisionObject& stones = tight.add(wall, at(0, 0, 0));
  btCollisionObject& ball = tight.add(sphere, at(0, 0, 0));
  const auto found = [&] {
    tight.world.performDiscreteCollisionDetection();
    return tight.has(stones, ball);
  };
  EXPECT_TRUE(found());  // the wall's box decides
  wall.addChildShape(at(0, 0, 0), torus.get());
  EXPECT_FALSE(found());
  wall.removeChildShape(torus.get());
  EXPECT_TRUE(found());
}

TEST(Broadphase, resetWhenEmptyItNumbersAnew) {
  btSphereShape sphere(btScalar(0.5));
  TightWorld tight;
  btCollisionObject& first = tight.add(sphere, at(0, 0, 0));
  const int id = first.getBroadphaseHandle()->getUid();
  tight.world.removeCollisionObject(&first);
  tight.broadphase.resetPool(&tight.dispatcher);
  tight.world.addCollisionObject(&first);
  EXPECT_EQ(first.getBroadphaseHandle()->getUid(), id);
}

}  // namespace
}  // namespace octoblisk
