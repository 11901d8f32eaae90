// Dynamics worlds with ClusteredOctreeBroadphase: nothing falls through, and bodies that clusters keep apart
// form no island.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/broadphase_worlds.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::shapeOf;

using DynamicWorld = testing::DynamicWorld<ClusteredOctreeBroadphase>;

TEST(BroadphaseDynamics, nothingFallsThrough) {
  const auto floor = shapeOf(testing::waveSheet(10, 0.4, 48));
  const auto ring = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  btSphereShape sphere(btScalar(0.4));
  btBoxShape box(toBullet(Vec3(0.4, 0.3, 0.5)));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 0), ring.get());
  compound.addChildShape(at(0, 0, 0.6), &sphere);
  btCollisionShape* const shapes[] = {ring.get(), &sphere, &box, &compound};
  DynamicWorld dynamic;
  dynamic.world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  dynamic.add(*floor, 0, at(0, 0, 0));
  std::mt19937_64 random(75);
  for (int i = 0; i < 60; ++i) {
    const Vec3 place(2.2 * (i % 5 - 2), 2.2 * (i / 5 % 4 - 1.5), 2.5 + 2.2 * (i / 20));
    btTransform pose = toBullet(Pose{testing::randomRotation(random), place});
    dynamic.add(*shapes[random() % 4], 1, pose);
  }
  int most_apart = 0;
  for (int step = 0; step < 360; ++step) {
    dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
    most_apart = std::max(most_apart, dynamic.broadphase.coarsePairs() - dynamic.pairs());
  }
  EXPECT_GT(most_apart, 10);
  int fallen = 0;
  for (std::size_t i = 1; i < dynamic.bodies.size(); ++i) {
    const Vec3 place = fromBullet(dynamic.bodies[i]->getWorldTransform().getOrigin());
    const bool over_the_floor = std::abs(place.x()) < 9.5 && std::abs(place.y()) < 9.5;
    EXPECT_TRUE(!over_the_floor || place.z() > -0.4) << "body " << i << " at " << place.transpose();
    fallen += over_the_floor && place.z() < 2.0;
  }
  EXPECT_GT(fallen, 40);
}

TEST(BroadphaseDynamics, aSleeperMovedByHandMeetsItsPairOnceAwake) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  DynamicWorld dynamic;
  dynamic.world.setGravity(btVector3(0, 0, 0));
  dynamic.add(*torus, 0, at(0, 0, 0));
  btRigidBody& sleeper = dynamic.add(sphere, 1, at(0, 0, 0));
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_EQ(dynamic.broadphase.coarsePairs(), 1);
  EXPECT_EQ(dynamic.pairs(), 0);

  sleeper.forceActivationState(ISLAND_SLEEPING);
  sleeper.setWorldTransform(at(1.2, 0, 0));  // 0.2 deep in the torus
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_EQ(dynamic.dispatcher.getNumManifolds(), 0);

  sleeper.activate(true);
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_EQ(dynamic.pairs(), 1);
  ASSERT_GT(dynamic.dispatcher.getNumManifolds(), 0);
  EXPECT_GT(dynamic.dispatcher.getManifoldByIndexInternal(0)->getNumContacts(), 0);
}

TEST(BroadphaseDynamics, whatIsInARingIsNoIslandWithIt) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  DynamicWorld dynamic;
  dynamic.world.setGravity(btVector3(0, 0, 0));
  const btRigidBody& ring = dynamic.add(*torus, 1, at(0, 0, 0));
  btRigidBody& ball = dynamic.add(sphere, 1, at(0, 0, 0));
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_NE(ring.getIslandTag(), ball.getIslandTag());
  ball.setWorldTransform(at(1.2, 0, 0));
  ball.setInterpolationWorldTransform(at(1.2, 0, 0));
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_EQ(ring.getIslandTag(), ball.getIslandTag());
}

}  // namespace
}  // namespace octoblisk
