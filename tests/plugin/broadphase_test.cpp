// Tests the pairs of ClusteredOctreeBroadphase and its statistics.
#include <gtest/gtest.h>

#include "cluster_test.h"
#include "octoblisk_bullet/convert.h"
#include "octoblisk_bullet/register.h"
#include "plugin/broadphase_worlds.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::shapeOf;
using testing::TightWorld;

TEST(Broadphase, aSphereInTheHoleOfATorusIsNoPair) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  TightWorld tight;
  btCollisionObject& ring = tight.add(*torus, at(5, 6, 7));
  btCollisionObject& ball = tight.add(sphere, at(5, 6, 7));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_EQ(tight.pairs(), 0);
  EXPECT_EQ(tight.dispatcher.getNumManifolds(), 0);

  ball.setWorldTransform(at(6.2, 6, 7));  // into the tube
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.pairs(), 1);
  ASSERT_TRUE(tight.has(ring, ball));
  ASSERT_GT(tight.dispatcher.getNumManifolds(), 0);
  EXPECT_GT(tight.dispatcher.getManifoldByIndexInternal(0)->getNumContacts(), 0);

  ball.setWorldTransform(at(5, 6, 7));  // back: the algorithm and its manifold go with the pair
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_EQ(tight.pairs(), 0);
  EXPECT_EQ(tight.dispatcher.getNumManifolds(), 0);
}

TEST(Broadphase, aTurnMakesAPairThoughNoBoxChanges) {
  // A blade turns about its own centre in a box of half its size. The sphere's corner is first clear and then
  // not.
  const auto blade = shapeOf(testing::boxMesh({2, 0.05, 0.05}));
  const auto torus = shapeOf(testing::torus(2, 0.1, 48, 12));
  btSphereShape sphere(btScalar(0.2));
  btCompoundShape cross;  // its box is the same after a quarter turn
  cross.addChildShape(at(0, 0, 0), blade.get());
  cross.addChildShape(btTransform(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI)), blade.get());
  TightWorld tight;
  btCollisionObject& turning = tight.add(cross, at(0, 0, 0));
  btCollisionObject& ball = tight.add(sphere, at(1, 1, 0));
  for (int i = 0; i < 4; ++i) {
    turning.setWorldTransform(btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(i) * SIMD_HALF_PI / 2)));
    tight.world.performDiscreteCollisionDetection();
    EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
    EXPECT_EQ(tight.has(turning, ball), i % 2 == 1) << i;
  }
}

TEST(Broadphase, ofTwoOfOursTheClustersCount) {
  const auto ring = shapeOf(testing::torus(2, 0.25, 48, 24)),
             small = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  TightWorld tight;
  btCollisionObject& outer = tight.add(*ring, at(0, 0, 0));
  btCollisionObject& inner = tight.add(*small, at(0, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_FALSE(tight.has(outer, inner));
  inner.setWorldTransform(at(0.75, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_TRUE(tight.has(outer, inner));
}

TEST(Broadphase, pairsWhoseBoxesHavePartedAreNotCoarsePairs) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  constexpr int kPairs = 20;
  const auto pose = [](int i, double between) { return at(20 * (i / 2) + between * (i % 2), 0, 0); };
  testing::StockWorld stock;
  TightWorld tight;
  for (int i = 0; i < 2 * kPairs; ++i) {
    stock.add(*torus, pose(i, 1));
    tight.add(*torus, pose(i, 1));
  }
  const auto step = [&](auto& world, double between) {
    for (int i = 0; i < 2 * kPairs; ++i) world.objects[std::size_t(i)]->setWorldTransform(pose(i, between));
    world.world.performDiscreteCollisionDetection();
  };
  step(stock, 1);
  step(tight, 1);
  ASSERT_EQ(tight.pairs(), kPairs);
  step(stock, 8);
  step(tight, 8);
  EXPECT_GT(stock.pairs(), kPairs / 2);  // Bullet removes a few pairs per step
  ASSERT_NO_FATAL_FAILURE(testing::expectPairsOf(stock, tight));
  EXPECT_EQ(tight.broadphase.coarsePairs(), 0);
}

// A test of clusters allows for some motion. Pairs must still be found in the step in which clusters meet.
TEST(Broadphase, creepingBodiesMeetInTime) {
  const auto ring = shapeOf(testing::torus(2, 0.25, 48, 24)),
             small = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  btBoxShape box(btVector3(1, btScalar(0.4), btScalar(0.2)));
  std::mt19937_64 random(37);
  int meetings = 0, steps_apart = 0;
  for (int run = 0; run < 60; ++run) {
    TightWorld tight;
    btCollisionShape* const shapes[] = {small.get(), &sphere, &box};
    btCollisionObject& outer = tight.add(*ring, at(3, 4, 5));
    btCollisionObject& inner = tight.add(*shapes[run % 3], at(3, 4, 5));
    const btVector3 way = toBullet(testing::randomRotation(random) * Vec3(0.02, 0, 0)),
                    axis = toBullet(Vec3(testing::randomRotation(random).col(0)));
    const btQuaternion turn(axis, btScalar(testing::uniform(random, 0, 0.05)));
    btCollisionObject& moving = run % 2 == 0 ? inner : outer;
    for (int step = 0; step < 100; ++step) {
      btTransform pose = moving.getWorldTransform();
      pose.setOrigin(pose.getOrigin() + way);
      pose.setRotation(turn * pose.getRotation());
      moving.setWorldTransform(pose);
      tight.world.performDiscreteCollisionDetection();
      const btBroadphaseProxy &a = *outer.getBroadphaseHandle(), &b = *inner.getBroadphaseHandle();
      detail::ClusterTest clusters(ClusteredOctreeBroadphase::kDefaultDepth);
      const bool meet = testing::boxesOverlap(&a, &b) && !clusters.separates(a, b);
      ASSERT_EQ(tight.has(outer, inner), meet) << "run " << run << ", step " << step;
      steps_apart += !meet;
      if (!meet) continue;
      ++meetings;
      break;
    }
  }
  EXPECT_GE(meetings, 40);
  EXPECT_GE(steps_apart, 1000);
}

// A pose that is not a number proves nothing about the poses before and after it.
TEST(Broadphase, bodiesMeetAfterAPoseThatIsNotANumber) {
  const auto ring = shapeOf(testing::torus(2, 0.5, 48, 24)),
             small = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  const btTransform clear = at(0, 0, 0), touching = at(1.2, 0, 0), none = at(std::nan(""), 0, 0);
  for (const btTransform& before : {clear, touching}) {
    TightWorld tight;
    btCollisionObject& outer = tight.add(*ring, at(0, 0, 0));
    btCollisionObject& inner = tight.add(*small, before);
    inner.setCollisionFlags(0);  // Bullet leaves the box of a body that is not static where it was
    const auto isPairAt = [&](const btTransform& pose) {
      inner.setWorldTransform(pose);
      inner.forceActivationState(ACTIVE_TAG);
      for (int i = 0; i < 3; ++i) tight.world.performDiscreteCollisionDetection();
      return tight.has(outer, inner);
    };
    EXPECT_EQ(isPairAt(before), before == touching);
    isPairAt(none);
    EXPECT_TRUE(isPairAt(touching));
    EXPECT_FALSE(isPairAt(clear));
  }
}

TEST(Broadphase, shapesMarginsAndScalesAreReadAnew) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5)), large(btScalar(1.6));
  btBoxShape box(btVector3(2, 2, 2));
  TightWorld tight;
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  btCollisionObject& ball = tight.add(sphere, at(0, 0, 0));
  const auto found = [&] {
    for (int i = 0; i < 3; ++i) tight.world.performDiscreteCollisionDetection();  // the pair is well known
    return tight.has(ring, ball);
  };
  EXPECT_FALSE(found());
  tight.reshape(ball, large);
  EXPECT_TRUE(found());
  tight.reshape(ball, sphere);
  EXPECT_FALSE(found());
  tight.reshape(ring, box);  // not the plugin's shape, so the boxes decide
  EXPECT_TRUE(found());
  tight.reshape(ring, *torus);
  EXPECT_FALSE(found());
  torus->setMargin(btScalar(1.05));
  EXPECT_TRUE(found());
  torus->setMargin(0);
  EXPECT_FALSE(found());
  torus->setLocalScaling(btVector3(btScalar(0.3), 1, 1));
  EXPECT_TRUE(found());
}

TEST(Broadphase, deeperClustersRejectMorePairs) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  torus->setMargin(0);
  btSphereShape sphere(btScalar(0.5));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 3), torus.get());
  compound.addChildShape(at(0, 0, -3), torus.get());
  for (const int depth : {0, 2}) {
    ClusteredOctreeBroadphase broadphase(depth);
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    registerAlgorithm(&dispatcher);
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btCollisionObject ring, two_rings, ball;
    ring.setCollisionShape(torus.get());
    two_rings.setCollisionShape(&compound);
    two_rings.setWorldTransform(at(50, 0, 0));
    ball.setCollisionShape(&sphere);
    for (btCollisionObject* object : {&ring, &two_rings, &ball}) world.addCollisionObject(object);
    world.performDiscreteCollisionDetection();
    EXPECT_EQ(broadphase.coarsePairs(), 1);
    EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), depth == 0 ? 1 : 0);
  }
}

}  // namespace
}  // namespace octoblisk
