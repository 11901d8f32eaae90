// Bodies stay on their side of open meshes, at 60 Hz and default settings.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shapes/sheets.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

constexpr double kStep = 1.0 / 60.0;
constexpr int kRuns = 12;

struct Kind {
  const char* name;
  std::function<std::unique_ptr<btCollisionShape>()> make;
};

std::unique_ptr<btCollisionShape> ours(const testing::SharedMesh& mesh) {
  return std::make_unique<ClusteredOctreeShape>(treeOver(mesh));
}

/// The middle of its box is outside.
std::unique_ptr<btCollisionShape> corner() {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    hull->addPoint(toBullet(0.8 * (point - Vec3::Constant(0.25))));
  return hull;
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"ball", [] { return std::make_unique<btSphereShape>(btScalar(0.05)); }},
      {"box", [] { return std::make_unique<btBoxShape>(toBullet(Vec3(0.3, 0.2, 0.1))); }},
      {"corner", corner},
      {"ring", [] { return ours(testing::torus(0.4, 0.1, 32, 12)); }},
      {"gear", [] { return ours(testing::gear(12, 0.4, 0.48, 0.15, 0.1)); }},
      {"channel", [] { return ours(testing::uProfile(0.3, 0.25, 0.05, 0.6)); }},
      {"plate",
       [] {
         return ours(testing::boxMesh({0.5, 0.5, 0.05}));
       }},
  };
  return all;
}

/// A flat square of 17 m in z = `height`. It faces up.
testing::SharedMesh flatFloor(double height = 0.0) {
  const auto floor = shapes::waveSheet(8.5, 0.0, 17);
  return testing::moved(*floor, {Mat3::Identity(), Vec3(0, 0, height)});
}

btTransform turnedAt(std::mt19937_64& random, double z) {
  return toBullet(Pose{testing::randomRotation(random), Vec3(0.13, 0.07, z)});
}

/// The contacts with impulses that push a body up, and down.
struct Pushes {
  int up = 0, down = 0;

  void count(BulletWorld& world, const btRigidBody& body) {
    for (int m = 0; m < world.dispatcher().getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *world.dispatcher().getManifoldByIndexInternal(m);
      const double on_body = manifold.getBody0() == &body ? 1.0 : -1.0;
      for (int p = 0; p < manifold.getNumContacts(); ++p) {
        const btManifoldPoint& point = manifold.getContactPoint(p);
        if (!(point.m_appliedImpulse > 0)) continue;
        const double along = on_body * double(point.m_normalWorldOnB.z());
        up += along > 0.3;
        down += along < -0.3;
      }
    }
  }
};

/// Bullet's own mesh shape, over the same triangles.
class StockFloor {
 public:
  explicit StockFloor(const testing::SharedMesh& mesh) : mesh_(*mesh), shape_(mesh_.view(), true) {}
  btBvhTriangleMeshShape& shape() { return shape_; }

 private:
  testing::BulletMesh mesh_;
  btBvhTriangleMeshShape shape_;
};

TEST(OpenMesh, bodiesThatFallOntoItStayAbove) {
  ClusteredOctreeShape floor = shapeOver(flatFloor());
  for (const Kind& kind : kinds()) {
    const std::unique_ptr<btCollisionShape> shape = kind.make();
    std::mt19937_64 random(81);
    Pushes pushes;
    for (int run = 0; run < kRuns; ++run) {
      BulletWorld world;
      world.add(floor, 0, at(0, 0, 0));
      btRigidBody& body = world.add(*shape, 1, turnedAt(random, 1.6));
      for (int step = 0; step < 120; ++step) {
        world.step(1, kStep);
        pushes.count(world, body);
      }
      EXPECT_GT(double(body.getWorldTransform().getOrigin().z()), 0.0) << kind.name << ' ' << run;
    }
    EXPECT_GT(pushes.up, 20 * kRuns) << kind.name;
    EXPECT_LE(pushes.down, pushes.up / 200) << kind.name;
  }
}

TEST(OpenMesh, bodiesThatComeFromBehindStayBehind) {
  ClusteredOctreeShape floor = shapeOver(flatFloor());
  int passed = 0;
  for (const Kind& kind : kinds()) {
    const std::unique_ptr<btCollisionShape> shape = kind.make();
    std::mt19937_64 random(82);
    int touched = 0;
    for (int run = 0; run < kRuns; ++run) {
      BulletWorld world;
      world->setGravity(btVector3(0, 0, 0));
      world.add(floor, 0, at(0, 0, 0));
      btRigidBody& body = world.add(*shape, 1, turnedAt(random, -1.5));
      body.setLinearVelocity(btVector3(0, 0, 3));
      world.step(120, kStep);
      touched += double(body.getLinearVelocity().z()) < 2.9;
      passed += double(body.getWorldTransform().getOrigin().z()) > 0.0;
    }
    EXPECT_EQ(touched, kRuns) << kind.name;
  }
  EXPECT_LE(passed, 1);  // a plate that comes edge first
}

/// The floor pushes up while the ceiling pushes down: the contacts of one do not show the side of the other.
TEST(OpenMesh, bodiesBetweenFloorAndCeilingStayThere) {
  constexpr double kHeight = 1.4;
  ClusteredOctreeShape room = shapeOver(testing::joined(*flatFloor(), *flatFloor(kHeight)));
  for (const Kind& kind : kinds()) {
    const std::unique_ptr<btCollisionShape> shape = kind.make();
    std::mt19937_64 random(83);
    std::uniform_real_distribution<double> speed(-3.0, 3.0);
    for (int run = 0; run < kRuns; ++run) {
      BulletWorld world;
      world.add(room, 0, at(0, 0, 0)).setRestitution(1);
      btRigidBody& body = world.add(*shape, 1, at(0.13, 0.07, 0.5 * kHeight));
      body.setRestitution(btScalar(0.8));
      body.setLinearVelocity(toBullet(Vec3(speed(random) / 3.0, speed(random) / 3.0, speed(random))));
      world.step(150, kStep);
      const double z = double(body.getWorldTransform().getOrigin().z());
      EXPECT_TRUE(z > 0.0 && z < kHeight) << kind.name << ' ' << run << ' ' << z;
    }
  }
}

/// The user takes a gear out of a valley and places it on a hill, deeper than the hill reaches into its bore.
TEST(OpenMesh, aBodyThatWasPlacedElsewhereIsPushedUp) {
  constexpr double kHeight = 1.0, kTop = 0.5 * std::numbers::pi, kHalf = 0.1, kDepth = 0.03;
  ClusteredOctreeShape hills = shapeOver(shapes::waveSheet(8.5, kHeight, 68));
  const std::unique_ptr<btCollisionShape> gear = ours(testing::gear(12, 0.4, 0.48, 0.15, kHalf));
  BulletWorld world;
  world->setGravity(btVector3(0, 0, 0));
  world.add(hills, 0, at(0, 0, 0));
  btRigidBody& body = world.add(*gear, 1, at(-kTop, 0, 0.25 - kHeight));
  body.setActivationState(DISABLE_DEACTIVATION);
  world.step(2, kStep);
  const double start = kHeight + kHalf - kDepth;
  body.setWorldTransform(at(kTop, 0, start));
  world.step(30, kStep);
  const double z = double(body.getWorldTransform().getOrigin().z());
  EXPECT_GT(z, start);
  EXPECT_LT(z, start + 0.5);
}

/// A body has moved by the length of the last step, not of the current one.
TEST(OpenMesh, stepsMayChangeTheirLength) {
  ClusteredOctreeShape floor = shapeOver(flatFloor());
  const std::unique_ptr<btCollisionShape> ring = ours(testing::torus(0.2, 0.03, 24, 8));
  std::mt19937_64 random(85);
  std::uniform_real_distribution<double> speed(-3.0, 3.0);
  Pushes pushes;
  for (int run = 0; run < 2 * kRuns; ++run) {
    BulletWorld world;
    world.add(floor, 0, at(0, 0, 0));
    btRigidBody& body = world.add(*ring, 1, turnedAt(random, 1.2));
    body.setLinearVelocity(toBullet(Vec3(speed(random), speed(random), 0.0)));
    body.setActivationState(DISABLE_DEACTIVATION);
    for (int step = 0; step < 200; ++step) {
      world.step(1, step % 2 == 0 ? 1.0 / 120.0 : 1.0 / 30.0);
      pushes.count(world, body);
    }
  }
  EXPECT_GT(pushes.up, 2000);
  EXPECT_LE(pushes.down, 5);
}

/// Bullet moves a kinematic body before the first step of a frame by the way of the whole frame.
TEST(OpenMesh, bodiesStayOnALiftInFramesOfSeveralSteps) {
  constexpr double kFrame = 1.0 / 30.0, kSpeed = 3.0;
  ClusteredOctreeShape floor = shapeOver(flatFloor());
  btBoxShape box(toBullet(Vec3(0.3, 0.2, 0.1)));
  const std::unique_ptr<btCollisionShape> gear = ours(testing::gear(12, 0.4, 0.48, 0.15, 0.1));
  int lost = 0;
  for (btCollisionShape* const shape : {static_cast<btCollisionShape*>(&box), gear.get()}) {
    std::mt19937_64 random(86);
    for (int run = 0; run < 2 * kRuns; ++run) {
      BulletWorld world;
      btRigidBody& lift = world.add(floor, 0, at(0, 0, 0));
      const int flags = run % 2 == 0 ? 0 : lift.getCollisionFlags();  // Bullet's own flag is CF_STATIC_OBJECT
      lift.setCollisionFlags(flags | btCollisionObject::CF_KINEMATIC_OBJECT);
      lift.setActivationState(DISABLE_DEACTIVATION);
      btRigidBody& body = world.add(*shape, 1, turnedAt(random, 0.7));
      double height = 0.0;
      for (int frame = 0; frame < 90; ++frame) {
        if (frame >= 30) height += kSpeed * kFrame;
        lift.setWorldTransform(at(0, 0, height));
        world->stepSimulation(btScalar(kFrame), 2, btScalar(0.5 * kFrame));
      }
      lost += double(body.getWorldTransform().getOrigin().z()) < height;
    }
  }
  EXPECT_LE(lost, 2);  // the lift moves by half the thickness of the box at once
}

/// Bullet's mesh lets all these balls through. Each moves by nearly its diameter in a step.
TEST(OpenMesh, smallFastBallsDoNotPass_vs_bvh) {
  const testing::SharedMesh mesh = flatFloor();
  ClusteredOctreeShape floor = shapeOver(mesh);
  StockFloor stock(mesh);
  btSphereShape ball(btScalar(0.05));
  const auto passed = [&](btCollisionShape& shape) {
    std::mt19937_64 random(84);
    std::uniform_real_distribution<double> height(1.4, 1.7);
    int below = 0;
    for (int run = 0; run < 3 * kRuns; ++run) {
      BulletWorld world;
      world.add(shape, 0, at(0, 0, 0));
      btRigidBody& body = world.add(ball, 1, turnedAt(random, height(random)));
      world.step(120, kStep);
      below += double(body.getWorldTransform().getOrigin().z()) < 0.0;
    }
    return below;
  };
  EXPECT_EQ(passed(floor), 0);
  EXPECT_GT(passed(stock.shape()), kRuns);
}

/// Their far ends come down at 8 m/s: farther in a step than the bodies are thick.
TEST(OpenMesh, thinBodiesThatTipOverLieDown) {
  constexpr double kThick = 0.03;
  btBoxShape slab(toBullet(Vec3(1.0, 1.0, 0.5 * kThick)));
  btBoxShape bar(toBullet(Vec3(0.5 * kThick, 1.0, 0.5 * kThick)));
  btCylinderShape rod(toBullet(Vec3(0.5 * kThick, 1.0, 0.5 * kThick)));
  btCapsuleShape capsule(btScalar(0.5 * kThick), btScalar(2.0 - kThick));
  ClusteredOctreeShape plate = shapeOver(testing::boxMesh({1.0, 1.0, 0.5 * kThick}));
  for (const int segments : {1, 9, 90}) {
    ClusteredOctreeShape floor = shapeOver(shapes::waveSheet(9.0, 0.0, segments));
    int runs = 0, lie = 0, awake = 0;
    for (btCollisionShape* const shape :
         {static_cast<btCollisionShape*>(&slab), static_cast<btCollisionShape*>(&bar),
          static_cast<btCollisionShape*>(&rod), static_cast<btCollisionShape*>(&capsule),
          static_cast<btCollisionShape*>(&plate)}) {
      for (const double tilt : {10.0, 35.0, 60.0}) {
        for (const double yaw : {0.0, 0.3}) {
          const Mat3 rotation = (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) *
                                 Eigen::AngleAxisd((90.0 - tilt) * std::numbers::pi / 180.0, Vec3::UnitX()))
                                    .matrix();
          BulletWorld world;
          world.add(floor, 0, at(0, 0, 0));
          btRigidBody& body = world.add(*shape, 1, toBullet(Pose{rotation, Vec3::Zero()}));
          btVector3 low, high;
          body.getAabb(low, high);
          body.translate(btVector3(0, 0, -low.z()));
          world.step(720, 1.0 / 120.0);
          const btTransform& end = body.getWorldTransform();
          ++runs;
          lie += double(end.getOrigin().z()) > 0.0 && std::abs(double(end.getBasis()[2][1])) < 0.02;
          const bool rolls = shape == &rod || shape == &capsule;
          awake += body.isActive() && !rolls;
        }
      }
    }
    EXPECT_EQ(lie, runs) << segments;
    EXPECT_EQ(awake, 0) << segments;
  }
}

/// Nothing is known about how a body got into a surface that it overlaps from the start: the shortest way
/// counts.
TEST(OpenMesh, whatOverlapsAtTheStartGoesTheShortestWay) {
  ClusteredOctreeShape floor = shapeOver(flatFloor());
  btBoxShape box(toBullet(Vec3(0.3, 0.3, 0.3)));
  for (const double side : {-1.0, 1.0}) {
    BulletWorld world;
    world->setGravity(btVector3(0, 0, 0));
    world.add(floor, 0, at(0, 0, 0));
    btRigidBody& body = world.add(box, 1, at(0.13, 0.07, 0.1 * side));
    body.setLinearVelocity(toBullet(Vec3(0, 0, -0.5 * side)));
    world.step(60, kStep);
    EXPECT_GT(side * double(body.getWorldTransform().getOrigin().z()), 0.25) << side;
  }
}

}  // namespace
}  // namespace octoblisk
