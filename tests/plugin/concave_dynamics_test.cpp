// Moving concave bodies against one another: piles, chains, thin sheets.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gallery/bullet_mesh.h"
#include "gallery/concave_pile.h"
#include "octoblisk/distance.h"
#include "octoblisk/mass_properties.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shapes/bodies.h"
#include "shared/block.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using gallery::ConcavePile;
using testing::at;
using testing::BulletWorld;

class PileOfSixtyFour : public ::testing::TestWithParam<unsigned> {};

TEST_P(PileOfSixtyFour, comesToRestAndStays) {
  ConcavePile pile(64, GetParam());
  for (std::size_t i = 0; i < pile.size(); ++i) pile.body(i).setActivationState(DISABLE_DEACTIVATION);
  double fastest = 0.0;
  for (int second = 1; second <= 6; ++second) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      for (int step = 0; step < 15; ++step) pile.step();
      fastest = std::max(fastest, pile.kineticEnergy());
    }
    ASSERT_EQ(pile.fallen(), 0) << "after " << second << " s";
    // While bodies fall on each other, the depth may reach the motion of one step at 6 m/s, because contacts
    // are found at its end.
    const ConcavePile::Depths depths = pile.depths();
    EXPECT_LT(depths.in_floor, 0.1) << "after " << second << " s";
    EXPECT_LT(depths.in_bodies, 0.1) << "after " << second << " s";
  }
  EXPECT_GT(fastest, 100.0);
  std::vector<Vec3> middles;
  for (std::size_t i = 0; i < pile.size(); ++i)
    middles.push_back(fromBullet(pile.body(i).getWorldTransform().getOrigin()));
  double energy = 0.0;
  for (int step = 0; step < 60; ++step) {
    pile.step();
    energy += pile.kineticEnergy() / 60.0;
  }
  EXPECT_LT(energy, 1.0);  // for 64 kg: the energy of a hop of 1.6 mm
  EXPECT_EQ(pile.fallen(), 0);
  EXPECT_LT(pile.depths().in_floor, 0.002);
  EXPECT_LT(pile.depths().in_bodies, 0.002);
  int moved = 0, lifted = 0;
  for (std::size_t i = 0; i < pile.size(); ++i) {
    const Vec3 middle = fromBullet(pile.body(i).getWorldTransform().getOrigin());
    moved += (middle - middles[i]).norm() > 0.1;
    lifted += middle.z() > testing::trayHeight(middle.x(), middle.y()) + 0.6;
  }
  EXPECT_LE(moved, 5);    // tori and stones may still roll
  EXPECT_GT(lifted, 10);  // they lie on one another and not side by side
}

/// In the last three, bodies that others had pushed into the open floor were once pulled down.
INSTANTIATE_TEST_SUITE_P(Seeds, PileOfSixtyFour, ::testing::Values(1u, 25u, 39u, 40u));

/// Cubes of twelve triangles and half size 1 are dropped on each other without a margin, on a floor of the
/// plugin's shape or of Bullet's. Their walls hardly meet, so a cube could be pushed out by its whole width.
TEST(ConcaveDynamics, coarseCubesStackWithoutAMargin) {
  for (const bool on_bvh : {false, true}) {
    const auto mesh = testing::boxMesh({1, 1, 1});
    ClusteredOctreeShape cube = shapeOver(mesh);
    gallery::BulletMesh source(*mesh);
    btBvhTriangleMeshShape bvh(source.view(), true);
    BulletWorld world;
    world.add(on_bvh ? static_cast<btCollisionShape&>(bvh) : cube, 0, at(0, 0, 0));
    std::vector<btRigidBody*> stack;
    for (int i = 1; i <= 4; ++i) {
      stack.push_back(&world.add(cube, 1, at(i % 2 ? 0.2 : 0.0, 0.1, 2.1 * i)));
    }
    world.step(4 * 240);
    for (std::size_t i = 0; i < stack.size(); ++i) {
      const Vec3 place = fromBullet(stack[i]->getWorldTransform().getOrigin());
      EXPECT_NEAR(place.z(), 2.0 * double(i + 1), 0.02) << i << (on_bvh ? " on BVH" : "");
      EXPECT_LT((place - Vec3(i % 2 ? 0.0 : 0.2, 0.1, place.z())).norm(), 0.02) << i;
    }
  }
}

/// Bodies whose edges coincide, with the default margin. They may not sleep.
TEST(ConcaveDynamics, equalBodiesStackEdgeOverEdge) {
  constexpr double kHalfHeight = 0.25;
  for (const auto& mesh :
       {testing::boxMesh({0.5, 0.5, kHalfHeight}), shapes::cylinder(0.5, kHalfHeight, 64)}) {
    ClusteredOctreeShape body(treeOver(mesh));
    ClusteredOctreeShape floor = shapeOver(testing::waveSheet(1.5, 0.0, 24));
    std::mt19937_64 random(4);
    BulletWorld world;
    world.add(floor, 0, at(0, 0, 0));
    const double margin = double(body.getMargin());
    std::vector<btRigidBody*> stack;
    for (int i = 0; i < 5; ++i) {
      const auto shift = [&] { return testing::uniform(random, -1e-4, 1e-4); };
      const double height = (2 * i + 1) * (kHalfHeight + margin);
      const Vec3 place{shift(), shift(), height};
      stack.push_back(&world.add(body, 1, at(place.x(), place.y(), place.z())));
      stack.back()->setActivationState(DISABLE_DEACTIVATION);
    }
    world.step(10 * 60, 1.0 / 60.0);
    for (int i = 0; i < 5; ++i) {
      const btRigidBody& placed = *stack[static_cast<std::size_t>(i)];
      EXPECT_NEAR(double(placed.getWorldTransform().getOrigin().z()), (2 * i + 1) * (kHalfHeight + margin),
                  0.02)
          << i << " of " << mesh->triangleCount() << " triangles";
      EXPECT_LT(double(placed.getLinearVelocity().length()), 0.05) << i;
    }
  }
}

/// Rods that lie on one of 24 narrow facets used to rock for more than a minute.
TEST(ConcaveDynamics, rodsOfNarrowFacetsFallAsleep) {
  ClusteredOctreeShape rod(treeOver(shapes::cylinder(0.06, 1.0, 24)));
  ClusteredOctreeShape floor(treeOver(testing::boxMesh({6, 6, 0.2})));
  std::mt19937_64 random(7);
  BulletWorld world;
  world.add(floor, 0, at(0, 0, -0.2));
  std::vector<btRigidBody*> rods;
  for (int i = 0; i < 12; ++i) {
    const btQuaternion lying(btVector3(1, 0, 0), SIMD_HALF_PI);
    const btQuaternion turn(btVector3(0, 0, 1), btScalar(testing::uniform(random, 0.0, 6.0)));
    rods.push_back(&world.add(rod, 1, at(0.6 * i - 3.3, 0, 0.07) * btTransform(lying * turn)));
  }
  world.step(30 * 60, 1.0 / 60.0);
  for (const btRigidBody* body : rods) EXPECT_FALSE(body->isActive());
}

/// 20 stacks of five coins of radius 10 cm. A quarter of them used to stand.
TEST(ConcaveDynamics, mostStacksOfCoinsStand) {
  constexpr double kRadius = 0.1, kHalfHeight = 0.01;
  ClusteredOctreeShape coin(treeOver(shapes::cylinder(kRadius, kHalfHeight, 32)));
  ClusteredOctreeShape floor(treeOver(testing::boxMesh({3, 3, 0.2})));
  const double gap = double(floor.getMargin()) + 3e-4, margin = double(coin.getMargin());
  std::mt19937_64 random(8);
  int standing = 0;
  for (int stack = 0; stack < 20; ++stack) {
    BulletWorld world;
    world.add(floor, 0, at(0, 0, -0.2));
    const btRigidBody* top = nullptr;
    for (int i = 0; i < 5; ++i) {
      const auto shift = [&] { return testing::uniform(random, -0.02, 0.02) * kRadius; };
      const double x = shift(), y = shift();
      const double z = gap + (2 * i + 1) * (kHalfHeight + margin) + i * 1e-4;
      top = &world.add(coin, 1, at(x, y, z));
    }
    world.step(10 * 60, 1.0 / 60.0);
    standing += top->getWorldTransform().getOrigin().z() > btScalar(0.09);
  }
  EXPECT_GE(standing, 13);
}

/// A bar of fine triangles that falls on another one sinks in by several triangles. It used to stay there, or
/// was thrown off with up to 9 J more; once its depth was that of a triangle, with up to 4 J more.
TEST(ConcaveDynamics, barsThatCrossPartWithoutGainingEnergy) {
  ClusteredOctreeShape bar =
      shapeOver(std::make_shared<const TriangleMesh>(testing::block({0.5, 0.08, 0.08}, 12)));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  int touched_deeply = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    std::mt19937_64 random(seed);
    BulletWorld world;
    world.add(plane, 0, at(0, 0, 0));
    world.add(bar, 0, at(0, 0, 0.6));
    const double fall = seed % 2 ? 1.0 : 3.0;
    const Vec3 place{testing::uniform(random, -0.3, 0.3), testing::uniform(random, -0.3, 0.3), 0.7 + fall};
    btRigidBody& falling = world.add(bar, 1, toBullet(Pose{testing::randomRotation(random), place}));
    const auto energy = [&] {
      return world.kineticEnergy() + 9.81 * double(falling.getWorldTransform().getOrigin().z());
    };
    const auto deepest = [&] {
      double least = 0.0;
      for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher()))
        least = std::min(least, double(point->getDistance()));
      return least;
    };
    double last = energy();
    for (int step = 0; step < 300; ++step) {
      world.step(1, 1.0 / 60.0);
      touched_deeply += deepest() < -0.02;
      ASSERT_LT(energy() - last, 0.5) << seed;
      last = energy();
    }
    EXPECT_GT(deepest(), -0.01) << seed;
  }
  EXPECT_GT(touched_deeply, 10);
}

/// Contacts as deep as the walls are high threw the cups over.
TEST(ConcaveDynamics, nestedCupsStand) {
  constexpr double kWall = 0.004, kRise = kWall / 0.2;  // of a cup over the cup that it sits in
  const testing::SharedMesh mesh = testing::cup(0.03, 0.05, 0.1, kWall, 24);
  const Vec3 center = massProperties(*mesh).center_of_mass;
  ClusteredOctreeShape cup = shapeOver(testing::moved(*mesh, {Mat3::Identity(), -center}));
  ClusteredOctreeShape floor = shapeOver(testing::boxMesh({1, 1, 0.5}));
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937_64 random(seed);
    BulletWorld world;
    world.add(floor, 0, at(0, 0, -0.5));
    std::vector<const btRigidBody*> cups;
    for (int i = 0; i < 3; ++i) {
      const double turn = testing::uniform(random, 0.0, 6.0), aside = testing::uniform(random, -3e-4, 3e-4);
      const Pose pose{Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix(),
                      Vec3(aside, 0.0, center.z() + 0.01 + i * (kRise + 0.006))};
      cups.push_back(&world.add(cup, 0.3, toBullet(pose)));
    }
    for (int step = 0; step < 480; ++step) world.step(1, 1.0 / 60.0);
    double below = center.z() - kRise;
    for (const btRigidBody* body : cups) {
      const btTransform& in_world = body->getWorldTransform();
      EXPECT_GT(in_world.getBasis()[2].z(), 0.98) << seed;
      EXPECT_NEAR(double(in_world.getOrigin().z()), below + kRise, 0.006) << seed;
      below = double(in_world.getOrigin().z());
    }
  }
}

/// Bodies of 8 cm rock by more than half a degree between two steps of 1/60 s. Of twenty boxes six glided for
/// ever, and of twenty tetrahedra twelve fell through the BVH floor.
TEST(ConcaveDynamics, smallBodiesFallAsleep) {
  const auto floor_mesh = testing::waveSheet(2.0, 0.0, 2);
  ClusteredOctreeShape floor = shapeOver(testing::boxMesh({4, 4, 0.5}));
  gallery::BulletMesh source(*floor_mesh);
  btBvhTriangleMeshShape bvh(source.view(), true);
  const testing::SharedMesh tetrahedron = std::make_shared<const TriangleMesh>(
      std::vector<Vec3>{{0, 0.04, -0.02}, {-0.04, -0.03, -0.02}, {0.04, -0.03, -0.02}, {0, 0, 0.05}},
      std::vector<TriangleMesh::Indices>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  for (const auto& mesh :
       {testing::boxMesh({0.04, 0.04, 0.03}), tetrahedron, testing::torus(0.04, 0.01, 24, 12)}) {
    ClusteredOctreeShape body = shapeOver(mesh);
    for (const bool on_bvh : {false, true}) {
      std::mt19937_64 random(105);
      int asleep = 0;
      constexpr int kBodies = 12;
      for (int i = 0; i < kBodies; ++i) {
        BulletWorld world;
        world.add(on_bvh ? static_cast<btCollisionShape&>(bvh) : floor, 0, at(0, 0, on_bvh ? 0.0 : -0.5));
        const Vec3 place(0.3, 0.2, 0.5);
        btRigidBody& falling = world.add(body, 1, toBullet(Pose{testing::randomRotation(random), place}));
        for (int step = 0; step < 600 && falling.isActive(); ++step) world.step(1, 1.0 / 60.0);
        asleep += !falling.isActive() && falling.getWorldTransform().getOrigin().z() > 0.0;
      }
      EXPECT_GE(asleep, kBodies - 1) << mesh->triangleCount() << " triangles" << (on_bvh ? " on BVH" : "");
    }
  }
}

/// Solid wheels of radius 0.5 m that roll for 4 s from 3 m/s. An edge that comes down takes a part of the
/// speed, because the impact is inelastic. The solver used to stop edges that do not reach the plane; with
/// 128 edges, a third of the speed was lost that way.
TEST(ConcaveDynamics, wheelsRoll_vs_closedForm) {
  for (const int edges : {32, 64, 128}) {
    constexpr double kRadius = 0.5, kSeconds = 4.0;
    const double turn = 2.0 * std::numbers::pi / edges, side = 2.0 * kRadius * std::sin(0.5 * turn);
    double expected = 3.0;
    for (double time = 0.0; time < kSeconds; time += side / expected)
      expected *= 1.0 - 2.0 / 3.0 * (1.0 - std::cos(turn));

    ClusteredOctreeShape wheel(treeOver(shapes::cylinder(kRadius, 0.2, static_cast<std::uint32_t>(edges))));
    btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
    BulletWorld world;
    world.add(plane, 0, at(0, 0, 0));
    const btQuaternion lying(btVector3(1, 0, 0), SIMD_HALF_PI);
    btRigidBody& rolling =
        world.add(wheel, 1, at(0, 0, kRadius + double(wheel.getMargin())) * btTransform(lying));
    rolling.setLinearVelocity(btVector3(3, 0, 0));
    rolling.setAngularVelocity(btVector3(0, btScalar(3 / kRadius), 0));
    world.step(static_cast<int>(kSeconds * 60.0), 1.0 / 60.0);
    EXPECT_NEAR(double(rolling.getLinearVelocity().length()), expected, 0.2 * expected) << edges << " edges";
  }
}

/// A fine block tips onto a fine floor. So many triangles are near its lower edge that the others get no
/// contacts until they are nearly as near.
TEST(ConcaveDynamics, fineBlocksThatTipOverAreStoppedInTime) {
  ClusteredOctreeShape floor =
      shapeOver(std::make_shared<const TriangleMesh>(testing::block({1, 1, 0.2}, 140)));
  const Vec3 half(0.5, 0.5, 0.2);
  ClusteredOctreeShape body = shapeOver(std::make_shared<const TriangleMesh>(testing::block(half, 70)));
  for (const double tilt : {0.005, 0.017}) {
    BulletWorld world;
    world.add(floor, 0, at(0, 0, -0.2));
    const btQuaternion tilted(btVector3(btScalar(0.3), 1, 0).normalized(), btScalar(tilt));
    const double height = half.z() * std::cos(tilt) + half.x() * std::sin(tilt) + 0.001;
    btRigidBody& falling = world.add(body, 1, at(0, 0, height) * btTransform(tilted));
    double lowest = 0.0;
    for (int step = 0; step < 60; ++step) {
      world.step(1, 1.0 / 60.0);
      const Pose pose = fromBullet(falling.getWorldTransform());
      for (const Vec3& corner : Aabb{-half, half}.corners()) lowest = std::min(lowest, (pose * corner).z());
    }
    EXPECT_GT(lowest, -0.0015) << "a tenth of the contact breaking threshold, at a tilt of " << tilt;
    EXPECT_LT(falling.getWorldTransform().getOrigin().z(), half.z() + 0.02);
  }
}

/// A rough mesh slides down a box by 20° for 1.5 s. Its triangles lean by up to 10°. When they pushed along
/// their own normals, such a body drifted and slid a fifth less.
TEST(ConcaveDynamics, roughMeshesSlideDownABox_vs_closedForm) {
  constexpr double kSlope = 20.0 * std::numbers::pi / 180.0, kFriction = 0.2, kSeconds = 1.5;
  btBoxShape box(btVector3(6, 6, 1));
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937_64 random(seed);
    const TriangleMesh smooth = testing::block({0.4, 0.4, 0.2}, 30);
    std::vector<Vec3> vertices = smooth.vertices();
    for (Vec3& vertex : vertices) vertex += testing::randomPoint(random, 0.0015);
    ClusteredOctreeShape rough =
        shapeOver(std::make_shared<const TriangleMesh>(vertices, smooth.triangles()));
    BulletWorld world;
    world->setGravity({0, btScalar(-9.81 * std::sin(kSlope)), btScalar(-9.81 * std::cos(kSlope))});
    world.add(box, 0, at(0, 0, -1)).setFriction(1);
    btRigidBody& body = world.add(rough, 1, at(0, 4, 0.205));
    body.setFriction(btScalar(kFriction));
    world.step(15, 1.0 / 60.0);
    const btVector3 start = body.getWorldTransform().getOrigin();
    const double speed = double(-body.getLinearVelocity().y());
    world.step(static_cast<int>(60 * kSeconds), 1.0 / 60.0);
    const btVector3 way = body.getWorldTransform().getOrigin() - start;
    const double acceleration = 9.81 * (std::sin(kSlope) - kFriction * std::cos(kSlope));
    const double expected = speed * kSeconds + 0.5 * acceleration * kSeconds * kSeconds;
    EXPECT_NEAR(double(-way.y()), expected, 0.03 * expected) << seed;
    EXPECT_NEAR(double(way.x()), 0.0, 0.03) << seed;
  }
}

/// The margins of the walls and of the block are thicker than the gaps between them. The block starts in the
/// middle, in touch with a wall, or overlapping it.
TEST(ConcaveDynamics, aBlockSlidesInATightChannel_vs_closedForm) {
  constexpr double kFriction = 0.1, kPush = 3.0, kSeconds = 1.5, kWall = 0.3;
  const Vec3 half(0.5, 0.3, 0.5);
  btBoxShape box(toBullet(half));
  ClusteredOctreeShape mesh(treeOver(testing::boxMesh(half)));
  for (const double gap : {0.001, 0.004, 0.008}) {
    ClusteredOctreeShape channel(treeOver(testing::uProfile(half.x() + gap + kWall, 0.5, kWall, 4)));
    ASSERT_GT(double(channel.getMargin()), gap);
    for (const double aside : {0.0, gap, gap + 0.0003}) {
      for (btCollisionShape* const shape :
           {static_cast<btCollisionShape*>(&box), static_cast<btCollisionShape*>(&mesh)}) {
        BulletWorld world;
        world->setGravity({0, btScalar(-9.81), 0});
        world.add(channel, 0, at(0, 0, 0)).setFriction(1);
        btRigidBody& block = world.add(*shape, 1, at(aside, 0.12, -3));
        block.setFriction(btScalar(kFriction));
        block.setActivationState(DISABLE_DEACTIVATION);
        world.step(30, 1.0 / 60.0);
        for (int step = 0; step < static_cast<int>(60 * kSeconds); ++step) {
          block.applyCentralForce({0, 0, kPush});
          world.step(1, 1.0 / 60.0);
        }
        const double expected = 0.5 * (kPush - kFriction * 9.81) * kSeconds * kSeconds;
        EXPECT_NEAR(double(block.getWorldTransform().getOrigin().z()) + 3.0, expected, 0.05 * expected)
            << gap << ' ' << aside;
      }
    }
  }
}

/// Its margins and those of the hole overlap on all sides.
TEST(ConcaveDynamics, aPegSlidesDownATightHoleAndRests) {
  for (const double gap : {0.0005, 0.001, 0.002}) {
    for (const int rate : {60, 240}) {
      ClusteredOctreeShape hole(treeOver(testing::tube(0.1 + gap, 0.2, 0.2, 32))),
          pin(treeOver(shapes::cylinder(0.1, 0.15, 32)));
      btStaticPlaneShape floor(btVector3(0, 0, 1), btScalar(-0.2));
      BulletWorld world;
      world.add(floor, 0, at(0, 0, 0));
      world.add(hole, 0, at(0, 0, 0));
      btRigidBody& peg = world.add(pin, 1, at(0, 0, 0));
      world.step(4 * rate, 1.0 / rate);
      EXPECT_FALSE(peg.isActive()) << gap << ' ' << rate;
      EXPECT_NEAR(double(peg.getWorldTransform().getOrigin().z()), -0.05, 0.003) << gap << ' ' << rate;
    }
  }
}

/// Moves the sides of a mesh apart by `slope` for each unit along y.
testing::SharedMesh tapered(const TriangleMesh& mesh, double slope) {
  return testing::deformed(mesh, [&](const Vec3& v) {
    return Vec3(v.x() + (v.x() < 0.0 ? -slope : slope) * v.y(), v.y(), v.z());
  });
}

/// Each gap narrows under the load. If the margins narrowed with it, the surfaces would meet.
TEST(ConcaveDynamics, loadedWedgesAndCantileversKeepMargins) {
  constexpr double kWall = 0.3, kSlope = 0.07, kFit = 0.5;  // a wedge at the height kFit fills its channel
  const auto channelOf = [](double half_width, double slope) {
    return treeOver(tapered(*testing::uProfile(half_width + kWall, 0.5, kWall, 2), slope));
  };
  const Vec3 block(0.5, 0.3, 0.5), bar(0.2, 1.0, 0.2);
  const auto wedge = treeOver(tapered(*testing::boxMesh(block), kSlope)),
             wedge_channel = channelOf(block.x() - kFit * kSlope, kSlope);
  struct Case {
    std::shared_ptr<const ClusteredOctree> channel, body;
    double height;
    Vec3 gravity;
  };
  for (const Case& loaded :
       {Case{wedge_channel, wedge, kFit + 0.3, {0, -9.81, 0}},
        Case{wedge_channel, wedge, kFit + 0.3, {0, -98.1, 0}},
        Case{channelOf(bar.x() + 0.004, 0), treeOver(testing::boxMesh(bar)), 0.81, {98.1, 0, 0}},
        Case{channelOf(bar.x() + 0.008, 0), treeOver(testing::boxMesh(bar)), 0.81, {98.1, 0, 0}}}) {
    const auto mesh = std::make_shared<const TriangleMesh>(loaded.body->mesh());
    for (const bool refits : {false, true}) {
      ClusteredOctreeShape channel(loaded.channel), shape(loaded.body);
      BulletWorld world;
      world->setGravity(toBullet(loaded.gravity));
      world.add(channel, 0, at(0, 0, 0)).setFriction(1);
      btRigidBody& body = world.add(shape, 1, at(0, loaded.height, 0));
      body.setFriction(1);
      body.setActivationState(DISABLE_DEACTIVATION);
      double least = std::numeric_limits<double>::infinity();
      for (int step = 1; step <= 600; ++step) {
        if (refits) shape.refit(mesh);
        world.step(1, 1.0 / 60.0);
        if (step % 60 != 0) continue;
        const Pose pose = fromBullet(body.getWorldTransform());
        least = std::min(least, distance(*loaded.channel, *loaded.body, pose).distance);
      }
      EXPECT_GT(least, 0.1 * double(shape.getMargin())) << loaded.gravity.transpose() << ' ' << refits;
      if (refits) continue;
      int oldest = 0;
      for (const btManifoldPoint* point : testing::manifoldPoints(*world->getDispatcher()))
        oldest = std::max(oldest, point->getLifeTime());
      EXPECT_GT(oldest, 60) << loaded.gravity.transpose();
    }
  }
}

/// When such a body rolls, its next corner touches at once. If that corner gets deep before it has a contact,
/// Bullet pushes it out, and the body never stops.
TEST(ConcaveDynamics, bodiesWithARoundBottomComeToRestOnAPlane) {
  constexpr std::uint32_t kSides = 24;
  std::vector<Vec3> vertices = {{0, 0, -0.04}, {0, 0, 0}};
  std::vector<TriangleMesh::Indices> triangles;
  const std::array<std::pair<double, double>, 3> rings = {{{0.02, -0.035}, {0.035, -0.02}, {0.04, 0.0}}};
  for (std::uint32_t side = 0; side < kSides; ++side) {
    const double angle = 2.0 * std::numbers::pi * side / kSides;
    for (const auto& [radius, height] : rings)
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    const std::uint32_t here = 2 + 3 * side, next = 2 + 3 * ((side + 1) % kSides);
    triangles.insert(triangles.end(), {{0, next, here}, {1, here + 2, next + 2}});
    for (const std::uint32_t ring : {0u, 1u}) {
      const std::uint32_t low = here + ring, low_next = next + ring;
      triangles.insert(triangles.end(), {{low, low_next, low_next + 1}, {low, low_next + 1, low + 1}});
    }
  }
  const TriangleMesh half(std::move(vertices), std::move(triangles));
  ASSERT_TRUE(massProperties(half).is_solid);
  ClusteredOctreeShape body =
      shapeOver(testing::moved(half, {Mat3::Identity(), -massProperties(half).center_of_mass}));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  std::mt19937_64 random(106);
  for (int i = 0; i < 8; ++i) {
    BulletWorld world;
    world.add(plane, 0, at(0, 0, 0)).setFriction(btScalar(0.8));
    btRigidBody& falling =
        world.add(body, 1, toBullet(Pose{testing::randomRotation(random), Vec3(0, 0, 0.07)}));
    falling.setFriction(btScalar(0.8));
    for (int step = 0; step < 12 * 240 && falling.isActive(); ++step) world.step(1, 1.0 / 240.0);
    EXPECT_FALSE(falling.isActive()) << i << ", " << falling.getAngularVelocity().length() << " rad/s";
  }
}

/// A bar stays on the edges of two boxes turned by 45°, or on two upright plates.
TEST(ConcaveDynamics, aCoarseBarLiesOnEdgesAndOnThinPlatesWithoutAMargin) {
  ClusteredOctreeShape bar = shapeOver(testing::boxMesh({1.5, 0.3, 0.2})),
                       box = shapeOver(testing::boxMesh({0.5, 1, 0.5})),
                       plate = shapeOver(testing::boxMesh({0.005, 1, 0.5}));
  const double edge = 0.5 * std::numbers::sqrt2;
  std::mt19937_64 random(61);
  for (int i = 0; i < 10; ++i) {
    for (const bool on_edges : {true, false}) {
      BulletWorld world;
      const btQuaternion turn(btVector3(0, 1, 0), on_edges ? btScalar(0.25 * std::numbers::pi) : 0);
      for (const double x : {-1.0, 1.0}) {
        world.add(on_edges ? box : plate, 0, btTransform(turn, btVector3(btScalar(x), 0, 0)));
      }
      const double top = (on_edges ? edge : 0.5) + 0.2, x = testing::uniform(random, -0.1, 0.1);
      btRigidBody& body = world.add(bar, 1, at(x, testing::uniform(random, -0.2, 0.2), top + 0.05));
      world.step(3 * 240);
      const Vec3 place = fromBullet(body.getWorldTransform().getOrigin());
      EXPECT_NEAR(place.z(), top, 0.02) << i << (on_edges ? ", edges" : ", plates");
      EXPECT_NEAR(place.x(), x, 0.2) << i << (on_edges ? ", edges" : ", plates");
    }
  }
}

/// Whether two rings of the same radius, each around the z axis of its pose, are linked. One ring meets the
/// other's plane at two points; if linked, exactly one of these is inside the other ring.
bool areLinked(const Pose& a, const Pose& b, double radius) {
  const Pose b_in_a = a.inverse() * b;
  const Vec3 &center = b_in_a.translation, x = b_in_a.rotation.col(0), y = b_in_a.rotation.col(1);
  const double slope = std::hypot(x.z(), y.z()) * radius;
  if (!(slope > std::abs(center.z()))) return false;
  const double middle = std::atan2(y.z(), x.z()), half = std::acos(-center.z() / slope);
  int within = 0;
  for (const double angle : {middle - half, middle + half}) {
    const Vec3 point = center + radius * (std::cos(angle) * x + std::sin(angle) * y);
    within += point.head<2>().norm() < radius;
  }
  return within == 1;
}

constexpr double kRingRadius = 0.5, kRingTube = 0.12;  // of the rings of chains

/// A hanging chain: a static torus and `links` moving ones, nearly touching.
std::vector<btRigidBody*> addChain(BulletWorld& world, btCollisionShape& torus, int links) {
  std::vector<btRigidBody*> rings;
  const btQuaternion upright(btVector3(1, 0, 0), SIMD_HALF_PI), across(btVector3(0, 0, 1), SIMD_HALF_PI);
  for (int i = 0; i <= links; ++i) {
    const btTransform pose(i % 2 == 0 ? upright : across * upright,
                           btVector3(0, 0, btScalar(-1.96 * (kRingRadius - kRingTube) * i)));
    rings.push_back(&world.add(torus, btScalar(i > 0), pose));
  }
  return rings;
}

/// A corner of each ring lies in a groove of the next and touches both sides. When one contact stood for
/// both, the rings rocked without end at 20 iterations.
TEST(ConcaveDynamics, aHangingChainFallsAsleep) {
  const auto shape = gallery::makeOurShape(testing::torus(kRingRadius, kRingTube, 32, 16));
  BulletWorld world;
  world->getSolverInfo().m_numIterations = 20;
  const std::vector<btRigidBody*> rings = addChain(world, *shape, 10);
  world.step(5 * 60, 1.0 / 60.0);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    EXPECT_FALSE(rings[i]->isActive()) << "link " << i;
    EXPECT_TRUE(areLinked(fromBullet(rings[i - 1]->getWorldTransform()),
                          fromBullet(rings[i]->getWorldTransform()), kRingRadius))
        << "link " << i;
  }
}

TEST(ConcaveDynamics, aChainOfTwelveHangsFromASwingingTorusForAMinute) {
  constexpr double kTimeStep = 1.0 / 60.0;
  constexpr int kLinks = 12;
  const auto shape = gallery::makeOurShape(testing::torus(kRingRadius, kRingTube, 20, 10));
  BulletWorld world;
  const std::vector<btRigidBody*> rings = addChain(world, *shape, kLinks);
  for (btRigidBody* const ring : rings) {
    ring->setActivationState(DISABLE_DEACTIVATION);
    ring->setDamping(btScalar(0.05), btScalar(0.05));
  }
  rings[0]->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);

  const auto pose = [&](int i) { return fromBullet(rings[std::size_t(i)]->getWorldTransform()); };
  double energy = 0.0, farthest = 0.0;
  for (int step = 0; step < 3600; ++step) {
    const double time = step * kTimeStep;  // the first ring swings for 20 s
    if (time < 20.0) {
      btTransform swung = rings[0]->getWorldTransform();
      swung.setOrigin(btVector3(btScalar(0.3 * std::sin(2.0 * time) * (1.0 - time / 20.0)), 0, 0));
      rings[0]->setWorldTransform(swung);
    }
    world.step(1, kTimeStep);
    double now = 0.0;
    for (int i = 1; i <= kLinks; ++i) {
      ASSERT_TRUE(areLinked(pose(i - 1), pose(i), kRingRadius)) << "link " << i << " at " << time << " s";
      farthest = std::max(farthest, (pose(i).translation - pose(i - 1).translation).norm());
      now += 0.5 * double(rings[std::size_t(i)]->getLinearVelocity().length2());
    }
    if (time >= 50.0) energy += now / 600.0;
  }
  // Round tubes touch at 2 (R - r), less two margins. These tubes have flat sides, and sway.
  EXPECT_LT(farthest, 2.0 * (kRingRadius - kRingTube) + 0.03);
  EXPECT_GT(farthest, 2.0 * (kRingRadius - kRingTube) - 0.03);
  EXPECT_LT(energy, 2.0);  // for 12 kg
}

/// The result of one second with a sheet that floats over another.
struct Floating {
  int contacts = 0;  ///< greatest number at a time
  double least_distance = std::numeric_limits<double>::infinity();
  double moved = 0.0;
};

Floating floatOver(const testing::SharedMesh& sheet, const btTransform& above) {
  ClusteredOctreeShape shape(treeOver(sheet));
  BulletWorld world;
  world->setGravity(btVector3(0, 0, 0));
  world.add(shape, 0, btTransform::getIdentity());
  btRigidBody& upper = world.add(shape, 1, above);
  upper.setActivationState(DISABLE_DEACTIVATION);
  Floating floating;
  for (int step = 0; step < 60; ++step) {
    world.step(1, 1.0 / 60.0);
    for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher()))
      floating.least_distance = std::min(floating.least_distance, double(point->getDistance()));
    floating.contacts = std::max(floating.contacts, world.contactPoints());
  }
  const btTransform& now = upper.getWorldTransform();
  floating.moved = double((now.getOrigin() - above.getOrigin()).length()) +
                   double((now.getBasis()[0] - above.getBasis()[0]).length());
  return floating;
}

TEST(ConcaveDynamics, sheetsThatDoNotTouchDoNotPush) {
  const btQuaternion flipped(btVector3(1, 0, 0), SIMD_PI), turned(btVector3(0, 0, 1), btScalar(0.4));
  for (const double waves : {0.0, 0.2}) {
    const auto sheet = testing::waveSheet(2, waves, 12);
    // Waves of shifted or flipped sheets would intersect, so only flat sheets are shifted or flipped.
    for (const btQuaternion& turn : {btQuaternion::getIdentity(), flipped, turned}) {
      if (waves > 0.0 && turn != btQuaternion::getIdentity()) continue;
      const auto apart = [&](double gap) {
        return floatOver(sheet, btTransform(turn, btVector3(0, 0, btScalar(gap))));
      };
      // The nearest points of wavy sheets do not lie one above the other.
      const Floating clear = apart(0.025), near = apart(0.01);
      EXPECT_EQ(clear.contacts, 0);
      EXPECT_LT(clear.moved, 1e-6);
      EXPECT_GT(near.contacts, 0);
      EXPECT_GT(near.least_distance, waves > 0.0 ? 0.008 : 0.0099);
      EXPECT_LT(near.moved, 1e-6);
    }
  }
}

}  // namespace
}  // namespace octoblisk
