// Closed meshes are solids. Bodies inside are pushed out in the shortest direction.
#include <BulletCollision/CollisionShapes/btConvexPointCloudShape.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;
using testing::PairReport;

/// The depth of a ball in a torus around z, along the shortest way out. The meshes are fine enough for 1 %.
double depthInTorus(const Vec3& center, double radius, double major, double minor) {
  const double from_tube = std::hypot(center.head<2>().norm() - major, center.z());
  return minor - from_tube + radius;
}

TEST(Solid, aBallInATorus_vs_closedForm) {
  constexpr double kMajor = 2.0, kMinor = 0.7, kRadius = 0.1;
  ClusteredOctreeShape torus = shapeOver(testing::torus(kMajor, kMinor, 96, 48));
  btSphereShape ball(btScalar{kRadius});
  btCollisionObject torus_object, ball_object;
  torus_object.setCollisionShape(&torus);
  ball_object.setCollisionShape(&ball);
  BulletWorld world;
  std::mt19937_64 random(71);
  int inside = 0;
  constexpr int kPlaces = 300;
  for (int i = 0; i < kPlaces; ++i) {
    Vec3 place = testing::randomPoint(random, 2.7);
    place.z() *= 0.3;
    ball_object.setWorldTransform(toBullet(Pose{Mat3::Identity(), place}));
    PairReport report;
    world->contactPairTest(&torus_object, &ball_object, report);
    const double depth = depthInTorus(place, kRadius, kMajor, kMinor);
    if (std::abs(depth) < 0.01 || std::abs(depth - kRadius) < 0.01) continue;
    inside += depth > kRadius;
    ASSERT_EQ(report.deepest() < 0.0, depth > 0.0) << i;
    if (depth > 0.0) {
      ASSERT_NEAR(report.deepest(), -depth, 0.01) << i;
    }
    torus.setSolid(false);
    PairReport of_surface;
    world->contactPairTest(&torus_object, &ball_object, of_surface);
    torus.setSolid(true);
    if (depth > 2.0 * kRadius + 0.01) {
      ASSERT_TRUE(of_surface.points.empty()) << i;
    }
  }
  EXPECT_GE(inside, kPlaces * 3 / 10);
  EXPECT_LE(inside, kPlaces * 7 / 10);
}

/// Bodies of every kind that start inside a block leave it and rest on it.
TEST(Solid, whatIsInsideComesOut) {
  ClusteredOctreeShape block = shapeOver(testing::boxMesh({4, 4, 1}));
  ClusteredOctreeShape ring = shapeOver(testing::torus(0.3, 0.1, 24, 12));
  btBoxShape box(btVector3(btScalar(0.2), btScalar(0.3), btScalar(0.25)));
  btSphereShape ball(btScalar(0.25));
  btCompoundShape compound;
  compound.addChildShape(at(-0.2, 0, 0), &ball);
  compound.addChildShape(at(0.3, 0, 0), &ring);
  for (const bool solid : {true, false}) {
    block.setSolid(solid);
    BulletWorld world;
    world.add(block, 0, at(0, 0, 0));
    const btRigidBody* bodies[] = {&world.add(ring, 1, at(-2, 0, 0.2)), &world.add(box, 1, at(0, 0, 0.2)),
                                   &world.add(ball, 1, at(2, 0, 0.2)),
                                   &world.add(compound, 1, at(0, 2, 0.2))};
    world.step(4 * 240);
    for (const btRigidBody* body : bodies) {
      const double height = double(body->getWorldTransform().getOrigin().z());
      if (solid) {
        EXPECT_GT(height, 1.05) << body - bodies[0];
        EXPECT_LT(height, 1.5);
      } else {
        EXPECT_LT(height, 1.0);
      }
    }
  }
}

/// Flat plates of 2 cm fall on a floor of 20 cm, up to 13 cm in a step, so many are wholly inside after a
/// step. One contact at a corner used to spin half of them, and let 24 of 64 through.
TEST(Solid, platesThatFallIntoAFloorComeOut) {
  ClusteredOctreeShape plate(treeOver(testing::boxMesh({0.15, 0.15, 0.01})));
  ClusteredOctreeShape floor(treeOver(testing::boxMesh({5, 5, 0.1})));
  for (const bool floor_first : {true, false}) {
    std::mt19937_64 random(11);
    const auto uniform = [&](double low, double high) {
      return btScalar(testing::uniform(random, low, high));
    };
    BulletWorld world;
    if (floor_first) world.add(floor, 0, at(0, 0, -0.1));
    constexpr int kPlates = 64;
    std::vector<btRigidBody*> plates;
    for (int i = 0; i < kPlates; ++i) {
      const btVector3 place(btScalar(i % 8 - 3.5), btScalar(i / 8 - 3.5), uniform(0.5, 3.0));
      const btVector3 axis = btVector3(uniform(-1, 1), uniform(-1, 1), 0).normalized();
      plates.push_back(&world.add(plate, 0.5, btTransform(btQuaternion(axis, uniform(-0.05, 0.05)), place)));
    }
    if (!floor_first) world.add(floor, 0, at(0, 0, -0.1));
    std::vector<bool> was_inside(kPlates), has_spun(kPlates);
    for (int step = 0; step < 2 * 60; ++step) {
      world.step(1, 1.0 / 60.0);
      for (std::size_t i = 0; i < kPlates; ++i) {
        if (plates[i]->getWorldTransform().getOrigin().z() < btScalar(-0.03)) was_inside[i] = true;
        if (plates[i]->getAngularVelocity().length() > 15) has_spun[i] = true;
      }
    }
    EXPECT_GE(std::ranges::count(was_inside, true), kPlates / 4);
    EXPECT_LE(std::ranges::count(has_spun, true), kPlates / 8);
    const auto isBelow = [](const btRigidBody* body) {
      return body->getWorldTransform().getOrigin().z() < 0;
    };
    EXPECT_LE(std::ranges::count_if(plates, isBelow), kPlates / 32);
  }
}

/// Its triangles push bodies inward, so it must not pass for a solid.
TEST(Solid, aMeshThatFacesInwardIsNone) {
  const auto torus = testing::torus(0.3, 0.1, 24, 12);
  const auto mirrored = testing::deformed(*torus, [](const Vec3& v) { return Vec3(-v.x(), v.y(), v.z()); });
  const ClusteredOctreeShape outward(treeOver(torus)), inward(treeOver(mirrored));
  EXPECT_TRUE(outward.isSolid());
  EXPECT_GT(outward.getMargin(), 0.0);
  EXPECT_FALSE(inward.isSolid());
  EXPECT_EQ(inward.getMargin(), 0.0);
  btVector3 of_outward, of_inward;
  outward.calculateLocalInertia(1, of_outward);
  inward.calculateLocalInertia(1, of_inward);
  EXPECT_NEAR((of_inward - of_outward).length(), 0.0, 1e-6);
}

/// Each triangle pushes the capsule sideways.
TEST(Solid, aCapsuleThatPiercesABallComesOut) {
  std::mt19937_64 random(83);
  auto ball = shapeOver(testing::bumpySphere(random, 1.0, 0.0, 24));
  constexpr double kRadius = 0.1, kHalfHeight = 0.3;
  btCapsuleShapeZ capsule(btScalar(kRadius), btScalar(2.0 * kHalfHeight));
  int pierces = 0;
  for (int i = 0; i < 20; ++i) {
    const Mat3 rotation = testing::randomRotation(random);
    const Vec3 outward = rotation.col(2);
    const double center = testing::uniform(random, 1.02, 1.5);
    BulletWorld world;
    world.add(ball, 0, at(0, 0, 0));
    btRigidBody& body = world.add(capsule, 1, toBullet(Pose{rotation, center * outward}));
    body.setGravity(btVector3(0, 0, 0));
    body.setDamping(btScalar(0.9), btScalar(0.9));
    pierces += center - kHalfHeight < 1.0 - 2.0 * kRadius;
    world.step(720);
    const Pose pose = fromBullet(body.getWorldTransform());
    double nearest = std::numeric_limits<double>::infinity();
    for (double along = -kHalfHeight; along <= kHalfHeight; along += 0.01)
      nearest = std::min(nearest, (pose * Vec3(0.0, 0.0, along)).norm());
    EXPECT_GT(nearest, 1.0 + kRadius - 0.03) << i << ", from " << center;
  }
  EXPECT_GE(pierces, 4);
  EXPECT_LE(pierces, 16);
}

/// The deepest contact of a mesh and a shape, both at the origin unless a pose is given.
double deepestOf(ClusteredOctreeShape& mesh, btCollisionShape& shape,
                 const btTransform& pose = btTransform::getIdentity()) {
  btCollisionObject mesh_object, object;
  mesh_object.setCollisionShape(&mesh);
  object.setCollisionShape(&shape);
  object.setWorldTransform(pose);
  BulletWorld world;
  PairReport report;
  world->contactPairTest(&mesh_object, &object, report);
  return report.deepest();
}

/// A cavity is outside.
TEST(Solid, aHollowIsOutside) {
  // A ball shell: an outer sphere of radius 2 and an inner one of 1.5, facing into the cavity.
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::mt19937_64 random(73);
  for (const double radius : {2.0, 1.5}) {
    const auto sphere = testing::bumpySphere(random, radius, 0.0, 24);
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), sphere->vertices().begin(), sphere->vertices().end());
    for (TriangleMesh::Indices corners : sphere->triangles()) {
      if (radius < 2.0) std::swap(corners[1], corners[2]);
      triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
    }
  }
  ClusteredOctreeShape shell = shapeOver(std::make_shared<const TriangleMesh>(vertices, triangles));
  ASSERT_TRUE(shell.isSolid());
  btSphereShape ball(btScalar(0.1));
  const auto deepestAt = [&](double x) { return deepestOf(shell, ball, at(x, 0, 0)); };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  EXPECT_EQ(deepestAt(0.0), kNone);
  EXPECT_EQ(deepestAt(1.2), kNone);
  EXPECT_LT(deepestAt(1.7), -0.2);
  EXPECT_EQ(deepestAt(2.2), kNone);
}

/// A shape whose origin is outside itself. The middle of each is outside or inside the block.
TEST(Solid, theOriginOfAShapeNeedNotBeInIt) {
  ClusteredOctreeShape block = shapeOver(testing::boxMesh({1, 1, 1}));
  for (const double x : {3.0, -0.2}) {
    const btVector3 corners[] = {toBullet(Vec3(x, 0, 0)), toBullet(Vec3(x + 0.8, 0, 0)),
                                 toBullet(Vec3(x, 0.8, 0)), toBullet(Vec3(x, 0, 0.8))};
    const btScalar radii[] = {btScalar(0.2), btScalar(0.2), btScalar(0.2), btScalar(0.2)};
    btMultiSphereShape spheres(corners, radii, 4);
    btConvexPointCloudShape cloud(const_cast<btVector3*>(corners), 4, btVector3(1, 1, 1));
    btBU_Simplex1to4 simplex(corners[0], corners[1], corners[2], corners[3]);
    btTriangleMesh triangles;
    triangles.addTriangle(corners[0], corners[1], corners[2]);
    triangles.addTriangle(corners[0], corners[1], corners[3]);
    btConvexTriangleMeshShape of_triangles(&triangles);
    btConvexHullShape hull(&corners[0][0], 4);
    const btTransform away = x > 0 ? at(0, 0, 0) : at(-2.5, 0, 0);  // the origin is inside, or outside
    for (btConvexShape* shape :
         std::initializer_list<btConvexShape*>{&spheres, &cloud, &simplex, &of_triangles})
      EXPECT_EQ(deepestOf(block, *shape, away), std::numeric_limits<double>::infinity()) << shape->getName();
    if (x > 0) {
      // Moved in: the middle of the shape is in the block, its origin is not.
      const double expected = deepestOf(block, hull, at(-3.2, 0, 0));
      EXPECT_LT(expected, -0.5);
      for (btConvexShape* shape : std::initializer_list<btConvexShape*>{&cloud, &simplex, &of_triangles}) {
        shape->setMargin(hull.getMargin());
        EXPECT_NEAR(deepestOf(block, *shape, at(-3.2, 0, 0)), expected, 0.3) << shape->getName();
      }
      EXPECT_LT(deepestOf(block, spheres, at(-3.2, 0, 0)), -0.5);
    }
  }
}

/// A plate cuts an edge of a thin box, and its middle is outside. Contacts that are apart do not count as
/// touching.
TEST(Solid, aPlateThroughAnEdgeTouches) {
  ClusteredOctreeShape block = shapeOver(testing::boxMesh({1, 0.953193254, 0.0381897957}));
  btBoxShape plate(btVector3(btScalar(0.00161766261), btScalar(0.037418399), btScalar(0.703926563)));
  plate.setMargin(0);
  const btTransform pose(btQuaternion(btScalar(0.524130702), btScalar(0.386726946), btScalar(-0.324648589),
                                      btScalar(0.685808003)),
                         btVector3(btScalar(-0.143126696), btScalar(0.655486465), btScalar(0.0671644732)));
  EXPECT_LT(deepestOf(block, plate, pose), -0.02);
}

/// The distances of all points of a world's manifolds, ascending.
std::vector<double> distancesIn(BulletWorld& world) {
  world->performDiscreteCollisionDetection();
  std::vector<double> distances;
  for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher()))
    distances.push_back(double(point->getDistance()));
  std::ranges::sort(distances);
  return distances;
}

/// No point of the solid stays after it has become a surface, and the reverse.
TEST(Solid, aPairForgetsItsPointsWhenItsMeshBecomesASurface) {
  std::mt19937_64 random(74);
  int differ = 0;
  for (int i = 0; i < 200; ++i) {
    ClusteredOctreeShape block = shapeOver(testing::torus(2.0, 0.7, 24, 12)),
                         ring = shapeOver(testing::torus(0.5, 0.2, 24, 12));
    btBoxShape box(toBullet(Vec3(0.2, 0.2, 0.2) + testing::randomPoint(random, 0.15)));
    btCollisionShape& other = i % 4 == 0 ? static_cast<btCollisionShape&>(ring) : box;
    Pose pose = testing::randomPose(random, 2.0);
    pose.translation.z() *= 0.3;
    const auto add = [&](BulletWorld& world) {
      world.add(block, 0, at(0, 0, 0));
      world.add(other, 1, toBullet(pose));
    };
    BulletWorld kept;
    add(kept);
    std::vector<double> before;
    for (const bool solid : {true, false, true}) {
      block.setSolid(solid);
      const std::vector<double> found = distancesIn(kept);
      BulletWorld fresh;
      add(fresh);
      ASSERT_EQ(found, distancesIn(fresh)) << i;
      differ += !found.empty() && found != before;
      before = found;
    }
  }
  EXPECT_GT(differ, 100);
}

/// A unit box below z = 0. Its first triangle has no area and lies in the diagonal of its top.
testing::SharedMesh boxWithASliver() {
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c) corners.emplace_back(c & 1, c >> 1 & 1, (c >> 2) - 1);
  corners.emplace_back(0.5, 0.5, 0);
  std::vector<TriangleMesh::Indices> triangles = {{4, 7, 8}, {4, 5, 7}, {4, 8, 6}, {8, 7, 6}};
  for (const auto& [a, b, c, d] :
       {std::array{0u, 2u, 3u, 1u}, {0u, 1u, 5u, 4u}, {1u, 3u, 7u, 5u}, {3u, 2u, 6u, 7u}, {2u, 0u, 4u, 6u}}) {
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  return std::make_shared<const TriangleMesh>(corners, triangles);
}

TEST(Solid, aTriangleWithoutAreaPushesOut) {
  ClusteredOctreeShape box = shapeOver(boxWithASliver());
  ASSERT_TRUE(box.isSolid());
  btSphereShape ball(btScalar(0.2));
  btCollisionObject box_object, ball_object;
  box_object.setCollisionShape(&box);
  ball_object.setCollisionShape(&ball);
  // The ball's centre is inside by less than rounding, and the closest triangle is the first.
  ball_object.setWorldTransform(at(0.25, 0.25, -1e-10));
  BulletWorld world;
  for (btCollisionObject* const object : {&box_object, &ball_object}) world->addCollisionObject(object);
  world->performDiscreteCollisionDetection();
  PairReport report;
  world->contactPairTest(&box_object, &ball_object, report);
  ASSERT_FALSE(report.points.empty());
  EXPECT_NEAR(report.deepest(), -0.2, 1e-6);
  for (btCollisionObject* const object : {&box_object, &ball_object}) world->removeCollisionObject(object);
}

}  // namespace
}  // namespace octoblisk
