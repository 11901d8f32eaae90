// Shapes whose vertices move: queries, scaling, and existing contacts.
#include <gtest/gtest.h>

#include <cmath>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/mass_properties.h"
#include "plugin/bullet_world.h"
#include "plugin/collected_triangles.h"
#include "plugin/shape_over.h"
#include "shared/brute_force.h"
#include "shared/message_of.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;
using testing::deformed;
using testing::messageOf;
using testing::SharedMesh;

TEST(ShapeRefit, processAllTriangles_vs_bruteforce) {
  std::mt19937_64 random(81);
  const SharedMesh mesh = testing::waveSheet(4, 0.3, 30);
  const SharedMesh bent = deformed(*mesh, [](const Vec3& v) {
    return Vec3(v.x() + 0.2 * v.z(), v.y(), v.z() + 0.5 * std::cos(v.x() + v.y()));
  });
  BulletMesh source(*mesh), moved(*bent);
  for (const Vec3& scaling : {Vec3(1, 1, 1), Vec3(2, 0.5, 1), Vec3(2, -0.5, 1)}) {
    ClusteredOctreeShape shape(source.view());
    shape.setLocalScaling(toBullet(scaling));
    const auto before = shape.sharedTree();
    const Vec3 corner = before->mesh().triangle(5)[0];
    shape.refit(moved.view());
    EXPECT_NE(shape.sharedTree(), before);
    EXPECT_EQ(before->mesh().triangle(5)[0], corner);  // others may share it
    shape.tree().validate();
    const bool mirrored = scaling.prod() < 0.0;
    std::size_t visited = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 center = testing::randomPoint(random, 4),
                 half = testing::randomPoint(random, 0.7).cwiseAbs();
      CollectedTriangles found;
      shape.processAllTriangles(&found, toBullet(center - half), toBullet(center + half));
      for (int t = 0; t < int(bent->triangleCount()); ++t) {
        Triangle expected = bent->triangle(std::size_t(t));
        for (Vec3& vertex : expected) vertex = vertex.cwiseProduct(scaling).eval();
        if (mirrored) std::swap(expected[1], expected[2]);
        const auto at = found.triangles.find({0, t});
        const bool meets = testing::boxTriangleOverlap({center, Mat3::Identity(), half}, expected) > 1e-5;
        ASSERT_TRUE(at != found.triangles.end() || !meets) << "box " << i << ", triangle " << t;
        if (at != found.triangles.end()) {
          for (std::size_t k = 0; k < 3; ++k) ASSERT_LT((at->second[k] - expected[k]).norm(), 1e-5);
        }
      }
      visited += found.triangles.size();
    }
    EXPECT_GT(visited, 100u);
    // Scaling starts from the moved vertices.
    shape.setLocalScaling(btVector3(3, 1, 1));
    const Vec3 scaled = shape.tree().mesh().triangle(7)[1];
    EXPECT_LT((scaled - bent->triangle(7)[1].cwiseProduct(Vec3(3, 1, 1))).norm(), 1e-5);
  }
}

TEST(ShapeRefit, massFollows) {
  const SharedMesh box = testing::boxMesh({1, 1, 1});
  ClusteredOctreeShape shape(treeOver(box));
  shape.refit(deformed(*box, [](const Vec3& v) { return Vec3(v.cwiseProduct(Vec3(1, 2, 3))); }));
  EXPECT_NEAR(shape.massProperties().volume, 48.0, 1e-12);
}

TEST(ShapeRefit, refusesAnotherMesh) {
  const SharedMesh mesh = testing::torus(2, 0.7, 12, 6);
  ClusteredOctreeShape shape(treeOver(mesh));
  const auto tree = shape.sharedTree();
  BulletMesh fewer(*testing::firstTriangles(*mesh, 143));
  EXPECT_EQ(messageOf([&] { shape.refit(fewer.view()); }),
            "ClusteredOctreeShape: refit with 143 triangles; the shape has 144");
  EXPECT_EQ(messageOf([&] { shape.refit(static_cast<const btStridingMeshInterface*>(nullptr)); }),
            "ClusteredOctreeShape: the mesh interface is null");
  EXPECT_EQ(messageOf([&] { shape.refit(SharedMesh()); }),
            "ClusteredOctreeShape: the mesh to refit to is null");
  auto turned = mesh->triangles();
  std::swap(turned[3][0], turned[3][1]);
  EXPECT_NE(messageOf([&] { shape.refit(std::make_shared<const TriangleMesh>(mesh->vertices(), turned)); }),
            "accepted");
  BulletMesh half(*testing::firstTriangles(*mesh, 72));
  btTriangleIndexVertexArray halves;
  for (int part = 0; part < 2; ++part) halves.addIndexedMesh(half.view()->getIndexedMeshArray()[0]);
  EXPECT_EQ(messageOf([&] { shape.refit(&halves); }),
            "ClusteredOctreeShape: to refit, triangles must stay in their parts");
  EXPECT_EQ(shape.sharedTree(), tree);
}

TEST(ShapeRefit, contactsOfBeforeAreGone) {
  // Bars lie on a floor, and one half of the floor sinks. Bullet keeps contacts by their positions on the
  // bodies, and the bodies have not moved.
  const SharedMesh flat = testing::waveSheet(4, 0.0, 16);
  const SharedMesh stepped =
      deformed(*flat, [](const Vec3& v) { return Vec3(v.x(), v.y(), v.x() > 0.01 ? -1.0 : 0.0); });
  const Vec3 half(1.5, 0.4, 0.3);
  ClusteredOctreeShape floor(treeOver(flat));
  ClusteredOctreeShape bar(treeOver(testing::boxMesh(half)));
  btBoxShape stock_bar(toBullet(half));
  for (btCollisionShape* shape :
       {static_cast<btCollisionShape*>(&bar), static_cast<btCollisionShape*>(&stock_bar)}) {
    testing::BulletWorld world;
    world.add(floor, 0, at(0, 0, 0));
    world.add(*shape, 1, at(0.1, 0.05, 0.295));
    const auto pointsOnEachSide = [&] {
      world->performDiscreteCollisionDetection();
      std::pair<int, int> points;
      for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher())) {
        const bool on_sunk_half = point->m_positionWorldOnA.x() > btScalar(0.6);
        ++(on_sunk_half ? points.second : points.first);
      }
      return points;
    };
    const auto before = pointsOnEachSide();
    EXPECT_GT(before.first, 0);
    EXPECT_GT(before.second, 0);
    floor.refit(stepped);
    const auto after = pointsOnEachSide();
    EXPECT_GT(after.first, 0);
    EXPECT_EQ(after.second, 0);
    floor.refit(flat);
    EXPECT_EQ(pointsOnEachSide().second, before.second);
  }
}

}  // namespace
}  // namespace octoblisk
