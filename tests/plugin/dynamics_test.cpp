// Bodies that fall on the plugin's shape, or have it, come to rest.
#include <gtest/gtest.h>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

void expectRest(const btRigidBody& body, double height, double tolerance) {
  EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), height, tolerance);
  EXPECT_LT(double(body.getLinearVelocity().length()), 0.05);
}

TEST(Dynamics, convexBodiesRestOnAFlatMesh) {
  auto floor = shapeOver(testing::waveSheet(20, 0.0, 20));
  btSphereShape sphere(btScalar(0.5));
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.3)));
  btCapsuleShape capsule(btScalar(0.3), btScalar(1.0));
  BulletWorld world;
  world.add(floor, 0, at(0, 0, 0));
  btRigidBody& ball = world.add(sphere, 1, at(-3.1, 0.2, 1.0));
  btRigidBody& brick = world.add(box, 1, at(0.3, 0.2, 0.8));
  btRigidBody& lying = world.add(capsule, 1, at(3.3, 0.2, 0.8));
  world.step(720);
  expectRest(ball, 0.5, 0.02);
  expectRest(brick, 0.3, 0.02);
  expectRest(lying, 0.3, 0.02);
}

/// Slides a body over a flat floor of small triangles and returns its greatest upward speed.
double bumpOf(btConvexShape& shape, double height) {
  auto floor = shapeOver(testing::waveSheet(20, 0.0, 80));
  BulletWorld world;
  world.add(floor, 0, at(0, 0, 0)).setFriction(0);
  btRigidBody& body = world.add(shape, 1, at(-8, 0.13, height));
  body.setFriction(0);
  world.step(240);  // comes to rest
  body.setLinearVelocity(btVector3(5, btScalar(0.7), 0));
  body.setActivationState(DISABLE_DEACTIVATION);
  double bump = 0.0;
  for (int step = 0; step < 480; ++step) {
    world.step(1);
    bump = std::max(bump, std::abs(double(body.getLinearVelocity().z())));
  }
  EXPECT_GT(double(body.getWorldTransform().getOrigin().x()), 1.0);  // it was not stopped
  EXPECT_NEAR(double(body.getLinearVelocity().x()), 5.0, 0.05);
  return bump;
}

TEST(Dynamics, nothingBumpsAgainstTheEdgesOfAFlatFloor) {
  btSphereShape sphere(btScalar(0.5));
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.3)));
  btCylinderShape wheel(btVector3(btScalar(0.5), btScalar(0.2), btScalar(0.5)));
  // Bullet's own mesh throws the three bodies up at 0.2 to 0.5.
  EXPECT_LT(bumpOf(sphere, 0.5), 0.001);
  EXPECT_LT(bumpOf(box, 0.3), 0.06);
  EXPECT_LT(bumpOf(wheel, 0.5), 0.06);
}

/// Bullet's own mesh takes up to half of the speed at 1/60 s.
TEST(Dynamics, aCylinderThatRollsKeepsItsSpeed) {
  constexpr double kRadius = 0.5, kSeconds = 4.0;
  for (const int cells : {1, 80}) {
    auto floor = shapeOver(testing::waveSheet(20, 0.0, cells));
    for (const double time_step : {1.0 / 60.0, 1.0 / 240.0}) {
      for (const double speed : {1.0, 3.0}) {
        btCylinderShape cylinder(btVector3(btScalar(kRadius), btScalar(0.4), btScalar(kRadius)));
        BulletWorld world;
        world.add(floor, 0, at(0, 0, 0));
        btRigidBody& body = world.add(cylinder, 1, at(-8, 0.13, kRadius));
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setLinearVelocity(btVector3(btScalar(speed), 0, 0));
        body.setAngularVelocity(btVector3(0, btScalar(speed / kRadius), 0));
        world.step(static_cast<int>(kSeconds / time_step), time_step);
        EXPECT_NEAR(double(body.getLinearVelocity().x()) / speed, 1.0, 0.05)
            << cells << " cells, " << time_step << " s, " << speed << " m/s";
        EXPECT_NEAR(double(body.getWorldTransform().getOrigin().x()), -8.0 + speed * kSeconds, 0.5);
      }
    }
  }
}

/// At this speed, a body keeps its contacts for several steps. The floor's middle is far away.
TEST(Dynamics, keptContactsDoNotSpeedUpABodyThatRolls) {
  constexpr double kRadius = 0.1, kSpeed = 0.1;
  auto floor = shapeOver(testing::waveSheet(60, 0.0, 80));
  btCapsuleShape capsule(btScalar(kRadius), btScalar(1.8));
  btCylinderShape cylinder(btVector3(btScalar(kRadius), 1, btScalar(kRadius)));
  for (btConvexShape* const shape : std::initializer_list<btConvexShape*>{&capsule, &cylinder}) {
    for (const bool is_floor_first : {true, false}) {
      BulletWorld world;
      if (is_floor_first) world.add(floor, 0, at(0, 0, 0));
      btRigidBody& body = world.add(*shape, 1, at(-20.13, 0.07, kRadius));
      if (!is_floor_first) world.add(floor, 0, at(0, 0, 0));
      body.setActivationState(DISABLE_DEACTIVATION);
      body.setLinearVelocity(btVector3(btScalar(kSpeed), 0, 0));
      body.setAngularVelocity(btVector3(0, btScalar(kSpeed / kRadius), 0));
      world.step(20 * 240, 1.0 / 240.0);
      EXPECT_NEAR(double(body.getLinearVelocity().x()), kSpeed, 0.25 * kSpeed)
          << shape->getName() << ", floor first " << is_floor_first;
    }
  }
}

TEST(Dynamics, aMovingTorusRestsOnAWavyMesh) {
  auto floor = shapeOver(testing::waveSheet(10, 0.3, 60));
  auto torus = shapeOver(testing::torus(1.5, 0.4, 32, 16));
  BulletWorld world;
  world.add(floor, 0, at(0, 0, 0));
  btRigidBody& ring = world.add(torus, 1, at(0, 0, 2));
  ring.setDamping(btScalar(0.05), btScalar(0.05));
  world.step(240 * 8);
  const double height = double(ring.getWorldTransform().getOrigin().z());
  EXPECT_GT(height, 0.3);
  EXPECT_LT(height, 1.2);
  EXPECT_LT(double(ring.getLinearVelocity().length()), 0.2);
}

TEST(Dynamics, aTorusHangsOnATorus) {
  auto torus = shapeOver(testing::torus(1.0, 0.2, 32, 16));
  BulletWorld world;
  world.add(torus, 0, btTransform(btQuaternion(btVector3(1, 0, 0), SIMD_HALF_PI)));
  btRigidBody& link = world.add(
      torus, 1,
      btTransform(btQuaternion(btVector3(0, 1, 0), SIMD_HALF_PI), btVector3(0, 0, btScalar(-1.45))));
  world.step(240 * 5);
  EXPECT_GT(double(link.getWorldTransform().getOrigin().z()), -1.75);  // linked, so the tubes hold each other
  EXPECT_LT(double(link.getLinearVelocity().length()), 1.0);
}

TEST(Dynamics, addingAndRemovingLeavesNothingBehind) {
  auto torus = shapeOver(testing::torus(1.5, 0.4, 32, 16));
  btSphereShape sphere(btScalar(0.5));
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  registerAlgorithm(&dispatcher);
  for (int round = 0; round < 10; ++round) {
    btCollisionObject a, b, c;
    a.setCollisionShape(&torus);
    b.setCollisionShape(&torus);
    c.setCollisionShape(&sphere);
    b.setWorldTransform(at(1, 0, 0));
    c.setWorldTransform(at(1.5, 0, 0.5));
    for (btCollisionObject* object : {&a, &b, &c}) world.addCollisionObject(object, 1, -1);
    world.performDiscreteCollisionDetection();
    EXPECT_GT(dispatcher.getNumManifolds(), 2);
    for (btCollisionObject* object : {&b, &a, &c}) world.removeCollisionObject(object);
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
    EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  }
}

}  // namespace
}  // namespace octoblisk
