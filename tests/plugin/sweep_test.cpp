// Convex sweeps through Bullet's world calls. The shape's fast path along a sweep finds the same hits as its
// generic path and as Bullet's own mesh.
#include <gtest/gtest.h>

#include "octoblisk/clustered_octree.h"
#include "plugin/cast_scenes.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;
using testing::Generic;
using testing::Hit;
using testing::Hits;
using testing::Object;
using testing::Scene;
using testing::scenes;
using testing::Way;

struct SweepHits final : btCollisionWorld::ConvexResultCallback, Hits {
  explicit SweepHits(bool all_hits) : Hits{all_hits} {}
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    return gather(result, m_closestHitFraction);
  }
};

/// Counts the triangles that it is cast at. Bullet calls getAngularMotionDisc once for each.
ATTRIBUTE_ALIGNED16(struct)
CountingHull final : btConvexHullShape {
  BT_DECLARE_ALIGNED_ALLOCATOR();
  explicit CountingHull(const Vec3& half_extents) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      addPoint(toBullet(half_extents.cwiseProduct(side)));
    }
  }
  btScalar getAngularMotionDisc() const override {
    ++casts;
    return btConvexHullShape::getAngularMotionDisc();
  }
  mutable int casts = 0;
};
class Sweeps : public ::testing::TestWithParam<Scene> {};

TEST_P(Sweeps, closestAndAll_vs_genericPath) {
  const Scene& scene = GetParam();
  ClusteredOctreeShape shape = scene.shape();
  std::mt19937_64 random(64);
  const btSphereShape sphere(btScalar(0.12));
  const btCapsuleShape capsule(btScalar(0.1), btScalar(0.3));
  const CountingHull box({0.2, 0.1, 0.05});
  int hits = 0, visited = 0, visited_generic = 0;
  std::size_t all_hits = 0;
  constexpr int kSweeps = 120;
  for (int i = 0; i < kSweeps; ++i) {
    shape.setMargin(btScalar(i % 4 == 0 ? 0.03 : 0.0));
    Generic generic(shape);
    generic.setMargin(shape.getMargin());
    const btTransform pose = toBullet(testing::randomPose(random, 3.0));
    const Object ours(shape, pose), oracle(generic, pose);
    const Way way = randomWay(random, scene);
    const Mat3 start = testing::randomRotation(random);
    const bool turns = i % 5 == 0;
    const Pose from{start, way.from}, to{turns ? testing::randomRotation(random) : start, way.to};
    const btConvexShape& convex = i % 3 == 0   ? static_cast<const btConvexShape&>(sphere)
                                  : i % 3 == 1 ? static_cast<const btConvexShape&>(capsule)
                                               : static_cast<const btConvexShape&>(box);
    SweepHits closest(false), expected_closest(false), all(true), expected_all(true);
    box.casts = 0;
    ours.sweep(convex, from, to, closest);
    visited += box.casts;
    ours.sweep(convex, from, to, all);
    oracle.sweep(convex, from, to, expected_closest);
    box.casts = 0;
    oracle.sweep(convex, from, to, expected_all);
    visited_generic += box.casts;
    ASSERT_EQ(closest.m_closestHitFraction, expected_closest.m_closestHitFraction) << "sweep " << i;
    ASSERT_EQ(all.sorted(), expected_all.sorted()) << "sweep " << i;
    hits += closest.hasHit();
    all_hits += all.found.size();
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
  EXPECT_GT(all_hits, std::size_t(2 * hits));
  EXPECT_GT(visited, 0);
  EXPECT_GT(visited_generic, 5 * visited);
}

TEST_P(Sweeps, closestAndAll_vs_bvh) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  BulletMesh source(shape.tree().mesh());
  btBvhTriangleMeshShape bvh(source.view(), true);
  bvh.setMargin(0);
  const Object ours(shape, btTransform::getIdentity()), stock(bvh, btTransform::getIdentity());
  const btBoxShape box(btVector3(btScalar(0.2), btScalar(0.1), btScalar(0.05)));
  std::mt19937_64 random(65);
  int hits = 0;
  constexpr int kSweeps = 60;
  for (int i = 0; i < kSweeps; ++i) {
    const Way way = randomWay(random, scene);
    const Pose from{testing::randomRotation(random), way.from}, to{from.rotation, way.to};
    SweepHits closest(false), expected(false);
    ours.sweep(box, from, to, closest);
    stock.sweep(box, from, to, expected);
    ASSERT_EQ(closest.hasHit(), expected.hasHit()) << "sweep " << i;
    ASSERT_NEAR(closest.m_closestHitFraction, expected.m_closestHitFraction, 1e-4) << "sweep " << i;
    hits += closest.hasHit();
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sweeps, ::testing::ValuesIn(scenes()), testing::nameOf);

TEST(Sweep, callbacksThatCollectWhateverTheyReturn) {
  // Bullet ignores the return value of a sweep's callback, so 0 does not end the sweep.
  struct Careless final : btCollisionWorld::ConvexResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult&, bool) override {
      ++hits;
      return 0;
    }
    int hits = 0;
  };
  const Scene scene = scenes()[0];
  const ClusteredOctreeShape shape = scene.shape();
  const Generic generic(shape);
  const btSphereShape sphere(btScalar(0.2));
  const Pose from{Mat3::Identity(), Vec3(-4, 0.1, 0.1)}, to{Mat3::Identity(), Vec3(4, 0.2, 0.3)};
  Careless ours, expected;
  Object(shape, btTransform::getIdentity()).sweep(sphere, from, to, ours);
  Object(generic, btTransform::getIdentity()).sweep(sphere, from, to, expected);
  EXPECT_GT(expected.hits, 10);
  EXPECT_EQ(ours.hits, expected.hits);
}

TEST(Sweep, throughTheWorld) {
  ClusteredOctreeShape shape = scenes()[0].shape();
  testing::BulletWorld world;
  world.add(shape, 0, testing::at(10, 0, 0));
  world.add(shape, 0, testing::at(20, 0, 0));
  const btVector3 from(0, 0, 0), to(40, 0, 0);
  btSphereShape ball(btScalar(0.3));
  btCollisionWorld::ClosestConvexResultCallback swept(from, to);
  world->convexSweepTest(&ball, btTransform(btQuaternion::getIdentity(), from),
                         btTransform(btQuaternion::getIdentity(), to), swept);
  ASSERT_TRUE(swept.hasHit());
  EXPECT_NEAR(swept.m_closestHitFraction * 40, 10 - 2.7 - 0.3, 1e-2);
}

}  // namespace
}  // namespace octoblisk
