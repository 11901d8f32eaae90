// The plugin's shape in a Bullet world: contacts of every pair, in both orders, from both tables.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/body_contacts.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

namespace {

using testing::at;
using testing::BulletMesh;
using testing::BulletWorld;
using testing::NamedConvex;
using testing::PairReport;

std::unique_ptr<btConvexShape> randomHull() {
  std::mt19937_64 random(33);
  auto hull = std::make_unique<btConvexHullShape>();
  for (int i = 0; i < 30; ++i) hull->addPoint(toBullet(testing::randomPoint(random, 0.6)));
  return hull;
}

const std::vector<NamedConvex> kConvexes = {
    {"sphere", [] { return std::make_unique<btSphereShape>(btScalar(0.6)); }},
    {"box",
     [] { return std::make_unique<btBoxShape>(btVector3(btScalar(0.7), btScalar(0.5), btScalar(0.3))); }},
    {"capsule", [] { return std::make_unique<btCapsuleShape>(btScalar(0.4), btScalar(0.8)); }},
    {"cylinder",
     [] {
       return std::make_unique<btCylinderShape>(btVector3(btScalar(0.5), btScalar(0.6), btScalar(0.5)));
     }},
    {"cone", [] { return std::make_unique<btConeShape>(btScalar(0.6), btScalar(1.0)); }},
    {"hull", randomHull},
};

class ConvexPairs : public ::testing::TestWithParam<NamedConvex> {};

TEST_P(ConvexPairs, contacts_vs_bvh) {
  const auto mesh = testing::torus(2, 0.7, 24, 12);
  ClusteredOctreeShape ours = shapeOver(mesh);
  ours.setSolid(false);  // like btBvhTriangleMeshShape
  BulletMesh source(*mesh);
  btBvhTriangleMeshShape bvh(source.view(), true);
  bvh.setMargin(0);
  const std::unique_ptr<btConvexShape> convex = GetParam().make();
  btCollisionObject ours_object, bvh_object, convex_object;
  ours_object.setCollisionShape(&ours);
  bvh_object.setCollisionShape(&bvh);
  convex_object.setCollisionShape(convex.get());
  BulletWorld world;
  std::mt19937_64 random(34);
  int hits = 0;
  constexpr int kPoses = 300;
  for (int i = 0; i < kPoses; ++i) {
    convex_object.setWorldTransform(toBullet(testing::randomPose(random, 2.4)));
    PairReport from_ours, from_bvh, swapped;
    world->contactPairTest(&ours_object, &convex_object, from_ours);
    world->contactPairTest(&bvh_object, &convex_object, from_bvh);
    world->contactPairTest(&convex_object, &ours_object, swapped);
    const bool ours_hits = from_ours.deepest() <= 0.0, bvh_hits = from_bvh.deepest() <= 0.0;
    hits += ours_hits;
    if (std::min(std::abs(from_ours.deepest()), std::abs(from_bvh.deepest())) > 1e-3) {
      ASSERT_EQ(ours_hits, bvh_hits) << "pose " << i;
      // Bullet's depth comes from its own GJK and EPA on the same triangles.
      ASSERT_TRUE(!ours_hits || std::abs(from_ours.deepest() - from_bvh.deepest()) < 0.03) << "pose " << i;
    }
    ASSERT_EQ(from_ours.points.size(), swapped.points.size());
    for (std::size_t p = 0; p < swapped.points.size(); ++p) {
      const auto &a = from_ours.points[p], &b = swapped.points[p];
      ASSERT_EQ(a.distance, b.distance);
      ASSERT_TRUE(a.normal.isApprox(-b.normal, 1e-5));
      ASSERT_TRUE(a.on_a.isApprox(b.on_b, 1e-4));
      ASSERT_EQ(a.index0, b.index1);
    }
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Pairs, ConvexPairs, ::testing::ValuesIn(kConvexes),
                         [](const auto& convex) { return convex.param.name; });

TEST(MeshPairs, contacts_vs_bruteforce) {
  const auto mesh_a = testing::torus(2, 0.7, 24, 12), mesh_b = testing::fan(5, 8);
  ClusteredOctreeShape a = shapeOver(mesh_a), b = shapeOver(mesh_b);
  for (ClusteredOctreeShape* shape : {&a, &b}) shape->setSolid(false);  // only contacts of triangles
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&a);
  object_b.setCollisionShape(&b);
  BulletWorld world;
  std::mt19937_64 random(35);
  int hits = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    object_a.setWorldTransform(toBullet(testing::randomPose(random, 1.0)));
    object_b.setWorldTransform(toBullet(testing::randomPose(random, 3.0)));
    const Pose world_a = fromBullet(object_a.getWorldTransform());
    const Pose b_in_a = world_a.inverse() * fromBullet(object_b.getWorldTransform());
    PairReport report, swapped;
    world->contactPairTest(&object_a, &object_b, report);
    world->contactPairTest(&object_b, &object_a, swapped);
    const double threshold = double(gContactBreakingThreshold), not_felt = threshold / 40.0;
    const Pose world_b = fromBullet(object_b.getWorldTransform());
    ASSERT_EQ(testing::faultOfContacts(*mesh_a, *mesh_b, b_in_a, threshold, not_felt, 1e-4,
                                       report.contacts(world_a, 0, 0)),
              "")
        << "pose " << i;
    ASSERT_EQ(testing::faultOfContacts(*mesh_b, *mesh_a, b_in_a.inverse(), threshold, not_felt, 1e-4,
                                       swapped.contacts(world_b, 0, 0)),
              "")
        << "pose " << i;
    if (!report.points.empty()) {
      ASSERT_NEAR(report.deepest(), swapped.deepest(), 1e-4);
    }
    hits += !report.points.empty();
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
}

TEST(MeshPairs, closestPointsReachAsFarAsAsked) {
  ClusteredOctreeShape box = shapeOver(testing::boxMesh({1, 1, 1}));
  btCollisionObject a, b;
  a.setCollisionShape(&box);
  b.setCollisionShape(&box);
  b.setWorldTransform(at(2.5, 0.3, 0.2));
  BulletWorld world;
  PairReport near, far;
  near.m_closestDistanceThreshold = btScalar(0.4);
  far.m_closestDistanceThreshold = btScalar(0.6);
  world->contactPairTest(&a, &b, near);
  world->contactPairTest(&a, &b, far);
  EXPECT_TRUE(near.points.empty());
  ASSERT_FALSE(far.points.empty());
  EXPECT_NEAR(far.deepest(), 0.5, 1e-6);
}

TEST(MeshPairs, marginsThickenTheSurface) {
  ClusteredOctreeShape box = shapeOver(testing::boxMesh({1, 1, 1}));
  box.setMargin(btScalar(0.1));
  btCollisionObject a, b;
  a.setCollisionShape(&box);
  b.setCollisionShape(&box);
  b.setWorldTransform(at(0, 0, 2.15));
  BulletWorld world;
  PairReport report;
  world->contactPairTest(&a, &b, report);
  EXPECT_NEAR(report.deepest(), -0.05, 1e-6);
  btSphereShape sphere(1);
  b.setCollisionShape(&sphere);
  b.setWorldTransform(at(0, 0, 2.05));
  PairReport with_sphere;
  world->contactPairTest(&a, &b, with_sphere);
  ASSERT_FALSE(with_sphere.points.empty());
  EXPECT_NEAR(with_sphere.deepest(), -0.05, 1e-5);
  EXPECT_NEAR(with_sphere.points[0].on_a.z(), 1.1, 1e-5);
}

TEST(Pairs, compoundsWorkThroughTheirChildren) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 5), &sphere);
  compound.addChildShape(at(0, 0, -5), &torus);
  btCollisionObject a, b, c;
  a.setCollisionShape(&torus);
  b.setCollisionShape(&compound);
  c.setCollisionShape(&sphere);
  BulletWorld world;
  b.setWorldTransform(at(2, 0, -4.0));  // the sphere child on the torus's tube
  PairReport sphere_child, torus_child, torus_sphere;
  world->contactPairTest(&a, &b, sphere_child);
  EXPECT_NEAR(sphere_child.deepest(), -0.18, 0.05);
  b.setWorldTransform(at(0.5, 0, 5));  // the torus child in the torus
  world->contactPairTest(&b, &a, torus_child);
  EXPECT_LT(torus_child.deepest(), 0.0);
  c.setWorldTransform(at(2.5, 0, 0.5));
  world->contactPairTest(&c, &b, torus_sphere);
  EXPECT_LT(torus_sphere.deepest(), 0.0);
}

TEST(Pairs, compoundChildrenKeepTheirNumbers) {
  ClusteredOctreeShape torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  btCompoundShape compound;
  for (int child = 0; child < 4; ++child) compound.addChildShape(at(0, 0, 5.0 * child), &sphere);
  btCollisionObject mesh, balls;
  mesh.setCollisionShape(&torus);
  balls.setCollisionShape(&compound);
  BulletWorld world;
  for (int child = 0; child < 4; ++child) {
    balls.setWorldTransform(at(2, 0, 1.0 - 5.0 * child));  // the child on the torus's tube
    PairReport report, swapped;
    world->contactPairTest(&mesh, &balls, report);
    world->contactPairTest(&balls, &mesh, swapped);
    ASSERT_FALSE(report.points.empty());
    ASSERT_EQ(report.points.size(), swapped.points.size());
    for (const PairReport& each : {report, swapped}) {
      for (const PairReport::Point& point : each.points) {  // Bullet puts the compound first in both orders
        EXPECT_EQ(point.part0, -1);
        EXPECT_EQ(point.index0, child);
        EXPECT_EQ(point.part1, 0);
        EXPECT_TRUE(point.index1 >= 0 && point.index1 < 24 * 12 * 2);
      }
    }
  }
}

TEST(Pairs, aBreakingThresholdSetLateCounts) {
  ClusteredOctreeShape floor = shapeOver(testing::waveSheet(5, 0.0, 10));
  floor.setContactBreakingThreshold(btScalar(0.019));
  btCompoundShape compound;  // keeps the bounds that its children had when they were added
  compound.addChildShape(at(0, 0, 0), &floor);
  btBoxShape box(btVector3(1, 1, 1));
  for (btCollisionShape* shape :
       {static_cast<btCollisionShape*>(&floor), static_cast<btCollisionShape*>(&compound)}) {
    BulletWorld world;
    world.add(*shape, 0, at(0, 0, 0));
    world.add(box, 1, at(0.2, 0.1, 1.008));
    const auto contactsWithin = [&](double threshold) {
      floor.setContactBreakingThreshold(btScalar(threshold));
      world->performDiscreteCollisionDetection();
      return world.contactPoints();
    };
    EXPECT_EQ(contactsWithin(0.01), 0);
    EXPECT_GT(contactsWithin(0.019), 0);
    EXPECT_EQ(contactsWithin(0.01), 0);
  }
}

/// Rounding there exceeds Bullet's thresholds.
TEST(Pairs, overlappingBodiesFarFromTheOriginHaveContacts) {
  std::mt19937_64 random(98);
  for (const double size : {1.0, 1e6, 1e7}) {
    for (int i = 0; i < 300; ++i) {
      const double height = testing::uniform(random, -size, size);
      auto sheet = shapeOver(
          testing::moved(*testing::waveSheet(2 * size, 0.0, 1), {Mat3::Identity(), Vec3(0.0, 0.0, height)}));
      btSphereShape ball(btScalar(0.01 * size));
      const double radius = double(ball.getRadius());
      BulletWorld world;
      btRigidBody& floor = world.add(sheet, 0, at(0, 0, testing::uniform(random, -size, size)));
      const double top = height + double(floor.getWorldTransform().getOrigin().z());
      btScalar middle = btScalar(top + radius);
      while (double(middle) - radius >= top) middle = std::nextafter(middle, -btScalar(BT_LARGE_FLOAT));
      world.add(ball, 1, at(0.1 * size, 0.2 * size, double(middle)));
      world->performDiscreteCollisionDetection();
      EXPECT_GT(world.contactPoints(), 0) << size << ' ' << i;
    }
  }
}

TEST(Pairs, manifoldsStayWithTheirPatches) {
  // A flat bar is tilted up at one end. The contacts at the other end keep their impulses.
  ClusteredOctreeShape floor = shapeOver(testing::waveSheet(5, 0.0, 10));
  ClusteredOctreeShape bar = shapeOver(testing::boxMesh({4, 0.5, 0.5}));
  BulletWorld world;
  world.add(floor, 0, at(0, 0, 0));
  btRigidBody& body = world.add(bar, 1, at(0, 0, 0.499));
  world->performDiscreteCollisionDetection();
  const auto warm = [&](double value) {
    int points = 0, kept = 0;
    for (btManifoldPoint* point : testing::manifoldPoints(world.dispatcher())) {
      ++points;
      kept += point->m_positionWorldOnA.x() > 0 && double(point->m_appliedImpulse) == value;
      point->m_appliedImpulse = point->m_positionWorldOnA.x() > 0 ? btScalar(7) : btScalar(0);
    }
    return std::pair(points, kept);
  };
  EXPECT_GT(warm(0).first, 0);
  body.setWorldTransform(
      btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(0.001)), btVector3(0, 0, btScalar(0.5))));
  world->performDiscreteCollisionDetection();
  EXPECT_GT(warm(7).second, 0);
}

TEST(Pairs, foreignShapesOfTheSameTypeAreLeftToBullet) {
  struct Foreign final : btBvhTriangleMeshShape {
    explicit Foreign(btStridingMeshInterface* source) : btBvhTriangleMeshShape(source, true) {
      m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
    }
  };
  BulletMesh source(*testing::torus(2, 0.7, 24, 12));
  Foreign foreign(source.view());
  btSphereShape sphere(btScalar(0.6));
  btCollisionObject mesh, ball;
  mesh.setCollisionShape(&foreign);
  ball.setCollisionShape(&sphere);
  ball.setWorldTransform(at(2, 0, 1));
  BulletWorld world;
  PairReport report, swapped;
  world->contactPairTest(&mesh, &ball, report);
  world->contactPairTest(&ball, &mesh, swapped);
  EXPECT_NEAR(report.deepest(), -0.3, 0.05);
  EXPECT_NEAR(swapped.deepest(), report.deepest(), 1e-5);
}

TEST(Pairs, contactAddedCallbackSeesTriangles) {
  ClusteredOctreeShape floor = shapeOver(testing::waveSheet(5, 0.0, 10));
  btSphereShape ball(1);
  BulletWorld world;
  btRigidBody& floor_body = world.add(floor, 0, at(0, 0, 0));
  world.add(ball, 1, at(0.3, 0.1, 0.99));
  floor_body.setCollisionFlags(floor_body.getCollisionFlags() |
                               btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  static int calls;
  static bool all_triangles;
  calls = 0;
  all_triangles = true;
  gContactAddedCallback = [](btManifoldPoint&, const btCollisionObjectWrapper* object0, int part0, int index0,
                             const btCollisionObjectWrapper* object1, int part1, int index1) {
    ++calls;
    const bool floor_is_0 = object0->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE;
    const auto* side = floor_is_0 ? object0 : object1;
    all_triangles &= side->getCollisionShape()->getShapeType() == TRIANGLE_SHAPE_PROXYTYPE &&
                     (floor_is_0 ? part0 : part1) == 0 && (floor_is_0 ? index0 : index1) >= 0;
    return false;
  };
  world.step(1);
  gContactAddedCallback = nullptr;
  EXPECT_GT(calls, 0);
  EXPECT_TRUE(all_triangles);
}

}  // namespace
}  // namespace octoblisk
