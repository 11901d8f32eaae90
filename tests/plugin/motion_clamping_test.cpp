// Thin bodies at 200 m/s tunnel through sheets unless their motions are clamped.
#include "octoblisk_bullet/motion_clamping.h"

#include <LinearMath/btTransformUtil.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

constexpr double kTube = 0.1;  // radius of the ring's tube
constexpr double kThreshold = kTube;

struct Throw {
  double speed = 200.0;
  double slant = 0.0;  ///< of the velocity from the sheet's normal, radians
  double tilt = 0.0;   ///< of the ring from lying flat, radians
  Vec3 spin = Vec3::Zero();
  double height = 3.0;
};

/// A ring thrown at a sheet in z = 0, from above.
struct Scene {
  Scene(ClusteredOctreeShape& sheet, ClusteredOctreeShape& ring, const Throw& thrown, bool clamped) {
    world->setGravity(btVector3(0, 0, 0));
    world.add(sheet, 0, at(0, 0, 0));
    body = &world.add(
        ring, 1,
        toBullet(Pose{Eigen::AngleAxisd(thrown.tilt, Vec3::UnitX()).matrix(), Vec3(0, 0, thrown.height)}));
    body->setLinearVelocity(
        toBullet(Vec3(thrown.speed * std::sin(thrown.slant), 0.0, -thrown.speed * std::cos(thrown.slant))));
    body->setAngularVelocity(toBullet(thrown.spin));
    body->setActivationState(DISABLE_DEACTIVATION);
    if (!clamped) return;
    body->setCcdMotionThreshold(btScalar(kThreshold));
    world->addAction(&clamping);
  }
  ~Scene() { world->removeAction(&clamping); }

  /// The number of the ring's vertices below the sheet.
  std::size_t below(const ClusteredOctreeShape& ring) const {
    const Pose pose = fromBullet(body->getWorldTransform());
    return static_cast<std::size_t>(std::ranges::count_if(
        ring.tree().mesh().vertices(), [&](const Vec3& v) { return (pose * v).z() < -2.0 * kTube; }));
  }

  MotionClamping clamping;
  BulletWorld world;
  btRigidBody* body;
};

class ThinRing : public ::testing::Test {
 protected:
  bool tunnels(ClusteredOctreeShape& sheet, const Throw& thrown, bool clamped) {
    Scene scene(sheet, ring_, thrown, clamped);
    for (int step = 0; step < 60; ++step) {
      scene.world.step(1);
      if (scene.below(ring_) > 0) return true;
    }
    return false;
  }

  ClusteredOctreeShape ring_ = shapeOver(testing::torus(1.0, kTube, 32, 12));
  ClusteredOctreeShape sheet_ = shapeOver(testing::waveSheet(60, 0.0, 8));
  ClusteredOctreeShape plate_ = shapeOver(testing::boxMesh({60, 60, 0.005}));
};

TEST_F(ThinRing, stopsAtASheetThatItTunnelsThrough) {
  std::mt19937_64 random(93);
  int tunnelled = 0, throws = 0;
  for (const double speed : {50.0, 200.0, 900.0}) {
    for (const double slant : {0.0, 0.5, 1.1}) {
      for (const double tilt : {0.0, 0.3, 1.2}) {
        for (const double spin : {0.0, 150.0}) {
          for (ClusteredOctreeShape* sheet : {&sheet_, &plate_}) {
            const Throw thrown{speed, slant, tilt, testing::randomPoint(random, spin),
                               testing::uniform(random, 1.5, 4.0)};
            ++throws;
            tunnelled += tunnels(*sheet, thrown, false);
            EXPECT_FALSE(tunnels(*sheet, thrown, true))
                << "speed " << speed << ", slant " << slant << ", tilt " << tilt << ", spin " << spin
                << (sheet == &plate_ ? ", plate" : ", sheet");
          }
        }
      }
    }
  }
  EXPECT_GT(tunnelled, throws / 2);
}

TEST(MotionClamping, withDefaultMarginsTheNextDetectionMakesContacts) {
  ClusteredOctreeShape block(treeOver(testing::boxMesh({20, 20, 5})));
  block.setContactBreakingThreshold(btScalar(0.4));  // for a margin of 0.2
  ASSERT_GT(block.getMargin(), 0.1);
  btSphereShape ball(btScalar(0.2));
  std::mt19937_64 random(96);
  int clamped = 0;
  for (int i = 0; i < 60; ++i) {
    MotionClamping clamping;
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    world->getDispatchInfo().m_useContinuous = false;
    world->addAction(&clamping);
    world.add(block, 0, at(0, 0, 0));
    btRigidBody& body = world.add(ball, 1,
                                  at(testing::uniform(random, -5, 5), testing::uniform(random, -5, 5),
                                     testing::uniform(random, 5.6, 7)));
    body.setLinearVelocity(
        toBullet(Vec3(testing::uniform(random, -100, 100), 0.0, -testing::uniform(random, 40, 200))));
    body.setCcdMotionThreshold(btScalar(0.2));
    for (int step = 0; step < 5 && clamping.clamped().empty(); ++step) world.step(1);
    if (!clamping.clamped().empty()) {
      ++clamped;
      world->performDiscreteCollisionDetection();
      EXPECT_GT(world.contactPoints(), 0) << i;
    }
    world->removeAction(&clamping);
  }
  EXPECT_GT(clamped, 30);
}

/// Bodies in a pile are moved back in most steps, and gravity acts in all of them.
TEST(MotionClamping, aPileGainsNoEnergy) {
  constexpr double kStep = 1.0 / 60.0;
  auto floor = shapeOver(testing::waveSheet(8, 0.0, 8));
  auto ring = shapeOver(testing::torus(0.4, 0.06, 32, 12));
  std::mt19937_64 random(97);
  MotionClamping clamping;
  BulletWorld world;
  world->addAction(&clamping);
  world.add(floor, 0, at(0, 0, 0));
  std::vector<btRigidBody*> rings;
  for (int i = 0; i < 12; ++i) {
    const Vec3 place(0.1 * (i % 3), 0.1 * (i % 2), 0.7 + 0.5 * i);
    rings.push_back(&world.add(ring, 1, toBullet(Pose{testing::randomRotation(random), place})));
    rings.back()->setCcdMotionThreshold(btScalar(0.06));
  }
  const auto energy = [&] {
    double sum = world.kineticEnergy();
    for (const btRigidBody* body : rings) sum += 9.81 * double(body->getWorldTransform().getOrigin().z());
    return sum;
  };
  const double start = energy();
  double least = start, risen = 0.0;
  int clamped = 0;
  for (int step = 0; step < 360; ++step) {
    world.step(1, kStep);
    clamped += clamping.clamped().size() > 2;
    risen = std::max(risen, energy() - least);
    least = std::min(least, energy());
  }
  world->removeAction(&clamping);
  EXPECT_GT(clamped, 40);
  EXPECT_LT(least, 0.3 * start);
  EXPECT_LT(risen, 0.01 * start);
}

/// A contact stops the push in the same step, so moving the body back must not take it from the velocity.
TEST(MotionClamping, aPushAtAWallDoesNotThrowTheBodyOff) {
  auto wall = shapeOver(testing::boxMesh({0.1, 50, 5}));
  auto cube = shapeOver(testing::boxMesh({0.5, 0.5, 0.5}));
  for (const double force : {10.0, 1000.0}) {
    MotionClamping clamping;
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    world->addAction(&clamping);
    world.add(wall, 0, at(0, 0, 0)).setFriction(0);
    btRigidBody& body = world.add(cube, 1, at(0.6 + double(wall.getMargin() + cube.getMargin()), -20, 0));
    body.setFriction(0);
    body.setAngularFactor(0);
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setLinearVelocity(btVector3(0, 30, 0));
    body.setCcdMotionThreshold(btScalar(0.05));
    world.step(10);
    body.applyCentralForce(btVector3(btScalar(-force), 0, 0));
    world.step(1);
    EXPECT_FALSE(clamping.clamped().empty());
    world.step(20);
    EXPECT_LT(std::abs(body.getLinearVelocity().x()), 0.01) << force;
    world->removeAction(&clamping);
  }
}

TEST_F(ThinRing, stopsAtARingThatComesTheOtherWay) {
  // Both move 5/6 per step, at least three times their thickness, and bounce.
  for (const bool clamped : {false, true}) {
    MotionClamping clamping;
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    btRigidBody &low = world.add(ring_, 1, at(0, 0, -2.3)), &high = world.add(ring_, 1, at(0.1, 0, 2.1));
    low.setLinearVelocity(btVector3(0, 0, 200));
    high.setLinearVelocity(btVector3(0, 0, -200));
    if (clamped) low.setCcdMotionThreshold(btScalar(kThreshold));  // one body's threshold is enough
    world->addAction(&clamping);
    bool put_back = false;
    for (int step = 0; step < 20; ++step) {
      world.step(1);
      put_back |= clamping.clamped().size() == 2;
      for (const auto& [body, fraction] : clamping.clamped()) {
        EXPECT_EQ(fraction, clamping.clamped()[0].fraction);
        EXPECT_TRUE(body == &low || body == &high);
      }
    }
    const bool passed = low.getWorldTransform().getOrigin().z() > high.getWorldTransform().getOrigin().z();
    EXPECT_EQ(passed, !clamped);
    EXPECT_EQ(put_back, clamped);
    world->removeAction(&clamping);
  }
}

TEST_F(ThinRing, doesNotMoveIntoOneThatIsPutBack) {
  // One flies behind the other at the same speed. They meet only because of the sheet.
  MotionClamping clamping;
  BulletWorld world;
  world->setGravity(btVector3(0, 0, 0));
  world.add(sheet_, 0, at(0, 0, 0));
  btRigidBody &far = world.add(ring_, 1, at(5, 0, 0.9)), &low = world.add(ring_, 1, at(0, 0, 0.5)),
              &high = world.add(ring_, 1, at(0, 0, 0.9));
  for (btRigidBody* body : {&far, &low, &high}) {
    body->setLinearVelocity(btVector3(0, 0, -200));
    body->setCcdMotionThreshold(btScalar(kThreshold));
  }
  world->addAction(&clamping);
  world.step(1);
  const auto heightOf = [](const btRigidBody& body) {
    return double(body.getWorldTransform().getOrigin().z());
  };
  EXPECT_NEAR(heightOf(high) - heightOf(low), 0.4, 1e-5);
  EXPECT_NEAR(heightOf(low), kTube + 0.005, 0.001);
  ASSERT_EQ(clamping.clamped().size(), 3u);
  EXPECT_GT(clamping.clamped()[0].fraction,
            clamping.clamped()[1].fraction);  // only the sheet clamps the far one
  EXPECT_EQ(clamping.clamped()[1].fraction, clamping.clamped()[2].fraction);
  for (int step = 0; step < 60; ++step) {
    world.step(1);
    ASSERT_GT(heightOf(low), -kTube);
    ASSERT_GT(heightOf(high), heightOf(low));
  }
  world->removeAction(&clamping);
}

TEST_F(ThinRing, isPutWhereTheImpactIsAndKeepsItsVelocity) {
  Scene scene(sheet_, ring_, {.height = 0.5}, true);
  scene.world.step(1);
  // The ring was 0.4 above the sheet. It is now a quarter of the breaking threshold of 0.02 above it, or
  // slightly more.
  ASSERT_EQ(scene.clamping.clamped().size(), 1u);
  EXPECT_EQ(scene.clamping.clamped()[0].body, scene.body);
  EXPECT_NEAR(scene.clamping.clamped()[0].fraction, 0.395 / 200.0 * 240.0, 0.002);
  const double height = double(scene.body->getWorldTransform().getOrigin().z()) - kTube;
  EXPECT_GT(height, 0.005 - 1e-5);
  EXPECT_LT(height, 0.005625 + 1e-5);
  EXPECT_EQ(scene.body->getLinearVelocity().z(), -200);
  scene.world.step(1);  // the solver has contacts now
  EXPECT_GT(scene.body->getLinearVelocity().z(), -3);
  EXPECT_GT(double(scene.body->getWorldTransform().getOrigin().z()), 0.9 * kTube);
}

/// Bullet draws a body between two steps by its interpolation velocities.
TEST_F(ThinRing, theInterpolationVelocitiesLeadBackToTheStartOfAClampedStep) {
  for (const double faster : {0.0, 1.0, 20.0}) {  // the last one spins by 109° in a step
    Scene scene(sheet_, ring_, {.spin = faster * Vec3(20, 10, 5), .height = 0.6}, true);
    const btTransform before = scene.body->getWorldTransform();
    scene.world.step(1);
    ASSERT_EQ(scene.clamping.clamped().size(), 1u);
    EXPECT_LT(scene.clamping.clamped()[0].fraction, 0.7);
    btTransform start;
    btTransformUtil::integrateTransform(
        scene.body->getWorldTransform(), -scene.body->getInterpolationLinearVelocity(),
        -scene.body->getInterpolationAngularVelocity(), btScalar(1.0 / 240.0), start);
    EXPECT_LT((start.getOrigin() - before.getOrigin()).length(), 1e-5);
    EXPECT_LT(start.getRotation().angleShortestPath(before.getRotation()), 2e-3) << faster;
  }
}

/// The positions of a scene's bodies after some steps, with or without clamping.
std::vector<Vec3> fly(bool clamped, const std::function<void(BulletWorld&)>& fill, btScalar threshold) {
  MotionClamping clamping;
  BulletWorld world;
  fill(world);
  for (int i = 0; i < world->getNumCollisionObjects(); ++i) {
    world->getCollisionObjectArray()[i]->setCcdMotionThreshold(threshold);
  }
  if (clamped) world->addAction(&clamping);
  world.step(30);
  std::vector<Vec3> places;
  for (int i = 0; i < world->getNumCollisionObjects(); ++i) {
    places.push_back(fromBullet(world->getCollisionObjectArray()[i]->getWorldTransform().getOrigin()));
  }
  if (clamped) world->removeAction(&clamping);
  return places;
}

TEST_F(ThinRing, whatIsNotAskedForIsLeftAlone) {
  btSphereShape ball(btScalar(0.2));
  btBoxShape block(btVector3(5, 5, btScalar(0.1)));
  const auto throwAt = [](BulletWorld& world, btCollisionShape& shape, double x) {
    world.add(shape, 1, at(x, 0, 3.03)).setLinearVelocity(btVector3(0, 0, -200));
  };
  // Without a threshold: convex bodies at the plugin's sheet and at each other, and its ring at a convex
  // body.
  const auto convex = [&](BulletWorld& world) {
    world.add(sheet_, 0, at(0, 0, 0));
    world.add(block, 0, at(20, 0, 0));
    throwAt(world, ball, 0);
    throwAt(world, ball, 20);
    throwAt(world, ring_, 20);
  };
  EXPECT_EQ(fly(true, convex, 0), fly(false, convex, 0));
  // Convex bodies alone.
  const auto alone = [&](BulletWorld& world) {
    world->getDispatchInfo().m_useContinuous = false;
    world.add(block, 0, at(20, 0, 0));
    throwAt(world, ball, 20);
  };
  EXPECT_EQ(fly(true, alone, btScalar(kThreshold)), fly(false, alone, btScalar(kThreshold)));
  // No threshold is set, the motions are shorter than it, or the filters keep the bodies from meeting.
  const auto ring = [&](BulletWorld& world) {
    world.add(sheet_, 0, at(0, 0, 0));
    throwAt(world, ring_, 0);
  };
  const auto ghost = [&](BulletWorld& world) {
    ring(world);
    btCollisionObject& sheet = *world->getCollisionObjectArray()[0];
    sheet.setCollisionFlags(sheet.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  };
  EXPECT_EQ(fly(true, ring, 0), fly(false, ring, 0));
  EXPECT_EQ(fly(true, ring, 1), fly(false, ring, 1));
  EXPECT_EQ(fly(true, ghost, btScalar(kThreshold)), fly(false, ghost, btScalar(kThreshold)));
  EXPECT_NE(fly(true, ring, btScalar(kThreshold)), fly(false, ring, btScalar(kThreshold)));
}

TEST_F(ThinRing, restsAsItDoesWithout) {
  const auto settle = [&](BulletWorld& world) {
    world.add(sheet_, 0, at(0, 0, 0));
    world.add(ring_, 1, at(0, 0, 0.12));
    world.add(ring_, 1, at(0.3, 0, 0.35));
    world.step(120);
  };
  EXPECT_EQ(fly(true, settle, btScalar(kThreshold)), fly(false, settle, btScalar(kThreshold)));
}

/// Bodies that are no more than a few tenths thick, convex ones and compounds of ours, and a thin plate for
/// each.
class ThinParts : public ::testing::Test {
 protected:
  ThinParts() {
    hull_.setMargin(btScalar(0.01));
    for (int i = 0; i < 12; ++i) {
      const double angle = i * std::numbers::pi / 6.0;
      hull_.addPoint(toBullet(Vec3(0.3 * std::cos(angle), 0.2 * std::sin(angle), i % 2 ? 0.1 : -0.1)));
    }
    rings_.addChildShape(at(-0.4, 0, 0), &ring_);
    rings_.addChildShape(btTransform(btQuaternion(btVector3(1, 0, 0), btScalar(1.5)), btVector3(0.4, 0, 0)),
                         &ring_);
    boxes_.addChildShape(at(-0.3, 0, 0), &box_);
    boxes_.addChildShape(at(0.3, 0, 0), &ball_);
    plates_.addChildShape(at(0, -30, 0), &half_plate_);
    plates_.addChildShape(at(0, 30, 0), &half_plate_);
  }

  struct Throw {
    btCollisionShape& floor;
    btCollisionShape& shape;
    Vec3 velocity, spin;
    double height;
    bool threshold_of_floor = false;
  };

  /// Whether the body gets to the floor's other side.
  static bool tunnels(const Throw& thrown, bool clamped) {
    MotionClamping clamping;
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    world->getDispatchInfo().m_useContinuous = false;
    btRigidBody& floor = world.add(thrown.floor, 0, at(0, 0, 0));
    btRigidBody& body = world.add(thrown.shape, 1, at(0, 0, thrown.height));
    body.setLinearVelocity(toBullet(thrown.velocity));
    body.setAngularVelocity(toBullet(thrown.spin));
    body.setActivationState(DISABLE_DEACTIVATION);
    (thrown.threshold_of_floor ? floor : body).setCcdMotionThreshold(btScalar(0.05));
    if (clamped) world->addAction(&clamping);
    bool below = false;
    for (int step = 0; step < 60 && !below; ++step) {
      world.step(1);
      below = body.getWorldTransform().getOrigin().z() < btScalar(-0.15);
    }
    if (clamped) world->removeAction(&clamping);
    return below;
  }

  ClusteredOctreeShape ring_ = shapeOver(testing::torus(0.5, 0.1, 20, 8)),
                       plate_ = shapeOver(testing::boxMesh({60, 60, 0.005})),
                       half_plate_ = shapeOver(testing::boxMesh({60, 30, 0.005}));
  btSphereShape ball_{btScalar(0.1)};
  btBoxShape box_{btVector3(btScalar(0.3), btScalar(0.2), btScalar(0.1))};
  btCapsuleShape capsule_{btScalar(0.1), btScalar(0.4)};
  btCylinderShape cylinder_{btVector3(btScalar(0.2), btScalar(0.1), btScalar(0.2))};
  btConvexHullShape hull_;
  btBoxShape thin_{btVector3(60, 60, btScalar(0.005))};
  btCompoundShape rings_, boxes_, plates_;
};

TEST_F(ThinParts, stopAtPlatesThatTheyTunnelThrough) {
  struct Pair {
    const char* name;
    btCollisionShape *floor, *shape;
  };
  const Pair pairs[] = {{"ball", &plate_, &ball_},
                        {"box", &plate_, &box_},
                        {"capsule", &plate_, &capsule_},
                        {"cylinder", &plate_, &cylinder_},
                        {"hull", &plate_, &hull_},
                        {"rings", &plate_, &rings_},
                        {"boxes", &plate_, &boxes_},
                        {"ball, plates", &plates_, &ball_},
                        {"rings, plates", &plates_, &rings_},
                        {"ring, thin box", &thin_, &ring_},
                        {"rings, thin box", &thin_, &rings_}};
  std::mt19937_64 random(94);
  for (const Pair& pair : pairs) {
    int tunnelled = 0, throws = 0;
    for (const double speed : {60.0, 200.0, 900.0}) {
      for (const double slant : {0.0, 0.9}) {
        for (const double spin : {0.0, 50.0}) {
          const Throw thrown{*pair.floor,
                             *pair.shape,
                             speed * Vec3(std::sin(slant), 0.0, -std::cos(slant)),
                             testing::randomPoint(random, spin),
                             testing::uniform(random, 1.5, 4.0),
                             throws % 2 == 1};
          ++throws;
          tunnelled += tunnels(thrown, false);
          EXPECT_FALSE(tunnels(thrown, true))
              << pair.name << ", speed " << speed << ", slant " << slant << ", spin " << spin;
        }
      }
    }
    EXPECT_GE(tunnelled, throws / 4) << pair.name;
  }
}

TEST_F(ThinParts, theOrderOfTheBodiesDoesNotCount) {
  std::vector<Vec3> places[2];
  for (const bool ball_first : {false, true}) {
    MotionClamping clamping;
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    world->getDispatchInfo().m_useContinuous = false;
    const auto addPlate = [&] { world.add(plates_, 0, at(0, 0, 0)); };
    if (!ball_first) addPlate();
    btRigidBody& body = world.add(boxes_, 1, at(0, 0, 3));
    if (ball_first) addPlate();
    body.setLinearVelocity(btVector3(10, 0, -300));
    body.setAngularVelocity(btVector3(10, 20, 0));
    body.setCcdMotionThreshold(btScalar(0.05));
    world->addAction(&clamping);
    int clamped = 0;
    for (int step = 0; step < 5; ++step) {
      world.step(1);
      clamped += static_cast<int>(clamping.clamped().size());
      if (clamped == 1 && !clamping.clamped().empty())
        places[ball_first].push_back(fromBullet(body.getWorldTransform().getOrigin()));
    }
    EXPECT_GT(clamped, 0);
    world->removeAction(&clamping);
  }
  EXPECT_EQ(places[0], places[1]);
}

TEST_F(ThinParts, whatBulletHasPutBackIsLeftThere) {
  BulletWorld world;
  world.add(plate_, 0, at(0, 0, 0));
  btRigidBody& body = world.add(ball_, 1, at(0, 0, 0));
  body.setLinearVelocity(btVector3(0, 0, -240));
  body.setCcdMotionThreshold(btScalar(0.05));
  for (const bool put_back : {false, true}) {
    // As Bullet leaves a body that has moved by 1 down, or would have.
    body.proceedToTransform(at(0, 0, -0.5));
    body.setHitFraction(put_back ? 0 : 1);
    MotionClamping clamping;
    clamping.updateAction(&*world, btScalar(1.0 / 240.0));
    EXPECT_EQ(clamping.clamped().empty(), put_back);
    EXPECT_EQ(body.getWorldTransform().getOrigin().z() < 0, put_back);
  }
}

TEST_F(ThinParts, aBodyThatIsNowhereIsNoMover) {
  MotionClamping clamping;
  BulletWorld world;
  world.add(plate_, 0, at(0, 0, 0)).setCcdMotionThreshold(btScalar(0.05));
  btRigidBody& body = world.add(box_, 1, at(0, 0, 3));
  body.setWorldTransform(at(std::nan(""), 0, 3));
  clamping.updateAction(&*world, btScalar(0.01));
  EXPECT_TRUE(clamping.clamped().empty());
}

}  // namespace
}  // namespace octoblisk
