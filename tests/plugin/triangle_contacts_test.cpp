// Compares the contact of a triangle and a convex shape with Bullet's own search.
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <gtest/gtest.h>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::BulletWorld;
using testing::NamedConvex;
using testing::PairReport;

const std::vector<NamedConvex> kShapes = {
    {"sphere", [] { return std::make_unique<btSphereShape>(btScalar(0.6)); }},
    {"capsule", [] { return std::make_unique<btCapsuleShape>(btScalar(0.3), btScalar(0.8)); }},
    {"box",
     [] { return std::make_unique<btBoxShape>(btVector3(btScalar(0.7), btScalar(0.5), btScalar(0.3))); }},
    {"hull", [] { return testing::roundHull(61, 20, 0.6); }},
};

/// The distance, or minus the depth if the two meet. The triangle has no margin.
double distanceByBullet(const Triangle& triangle, const btConvexShape& shape, const btTransform& pose) {
  btTriangleShape flat(toBullet(triangle[0]), toBullet(triangle[1]), toBullet(triangle[2]));
  flat.setMargin(0);
  btVoronoiSimplexSolver simplex;
  btGjkEpaPenetrationDepthSolver depth;
  btGjkPairDetector detector(&shape, &flat, &simplex, &depth);
  btGjkPairDetector::ClosestPointInput input;
  input.m_transformA = pose;
  input.m_transformB.setIdentity();
  btPointCollector found;
  detector.getClosestPoints(input, found, nullptr);
  return found.m_hasResult ? double(found.m_distance) : 1e30;
}

class TriangleContacts : public ::testing::TestWithParam<NamedConvex> {};

TEST_P(TriangleContacts, distancesAndDepths_vs_btGjkPairDetector) {
  constexpr double kOfBullet = 2e-3;  // error of Bullet's single-precision search for bodies of size 1
  const std::unique_ptr<btConvexShape> shape = GetParam().make();
  btCollisionObject triangle_object, shape_object;
  shape_object.setCollisionShape(shape.get());
  shape_object.setWorldTransform(btTransform::getIdentity());
  BulletWorld world;
  std::mt19937_64 random(62);
  int hits = 0, equal = 0;
  constexpr int kCases = 1000;
  for (int i = 0; i < kCases; ++i) {
    Triangle triangle = testing::randomTriangle(random, i % 2 ? 0.4 : 3.0);
    const Vec3 shift = testing::randomPoint(random, 0.9) - centroidOf(triangle);
    for (Vec3& corner : triangle) corner += shift;
    const auto mesh =
        std::make_shared<const TriangleMesh>(std::vector<Vec3>(triangle.begin(), triangle.end()),
                                             std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    ClusteredOctreeShape ours(treeOver(mesh));
    triangle_object.setCollisionShape(&ours);
    triangle_object.setWorldTransform(btTransform::getIdentity());
    PairReport report;
    world->contactPairTest(&triangle_object, &shape_object, report);
    const double by_bullet = distanceByBullet(triangle, *shape, btTransform::getIdentity());
    if (by_bullet > kOfBullet) {
      ASSERT_GT(report.deepest(), by_bullet - kOfBullet) << "case " << i;  // far: none
      if (!report.points.empty()) {
        ASSERT_NEAR(report.deepest(), by_bullet, kOfBullet) << "case " << i;
      }
      continue;
    }
    if (by_bullet > -kOfBullet) continue;
    ++hits;
    // The way out is no longer than Bullet's. Bullet confirms this after the triangle has moved along it.
    ASSERT_GE(report.deepest(), by_bullet - kOfBullet) << "case " << i;
    equal += std::abs(report.deepest() - by_bullet) < kOfBullet;
    const auto deepest = std::ranges::min_element(report.points, {}, &PairReport::Point::distance);
    Triangle moved = triangle;  // the triangle is A: the normal points to it
    for (Vec3& corner : moved) corner += (kOfBullet - deepest->distance) * deepest->normal;
    ASSERT_GT(distanceByBullet(moved, *shape, btTransform::getIdentity()), -kOfBullet) << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
  EXPECT_EQ(equal, hits);
}

INSTANTIATE_TEST_SUITE_P(Shapes, TriangleContacts, ::testing::ValuesIn(kShapes),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace octoblisk
