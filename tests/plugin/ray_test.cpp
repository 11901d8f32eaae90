// Rays through Bullet's world calls. The shape's fast path along a ray finds the same hits as its generic
// path and as Bullet's own mesh.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <gtest/gtest.h>

#include <optional>

#include "octoblisk/raycast.h"
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

using RayCallback = btTriangleRaycastCallback;

/// All hits, or the closest.
struct RayHits final : btCollisionWorld::RayResultCallback, Hits {
  RayHits(bool all_hits, unsigned flags) : Hits{all_hits} { m_flags = flags; }
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool) override {
    m_collisionObject = result.m_collisionObject;
    return gather(result, m_closestHitFraction);
  }
};

class Rays : public ::testing::TestWithParam<Scene> {};

TEST_P(Rays, closestAndAll_vs_genericPath) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  const Generic generic(shape);
  std::mt19937_64 random(61);
  int hits = 0;
  std::size_t all_hits = 0;
  constexpr int kRays = 1000;
  for (int i = 0; i < kRays; ++i) {
    const btTransform pose = toBullet(testing::randomPose(random, 3.0));
    const Object ours(shape, pose), oracle(generic, pose);
    const Way way = randomWay(random, scene);
    for (const unsigned flags :
         {0u, unsigned(RayCallback::kF_FilterBackfaces), unsigned(RayCallback::kF_KeepUnflippedNormal),
          unsigned(RayCallback::kF_FilterBackfaces) | unsigned(RayCallback::kF_KeepUnflippedNormal)}) {
      RayHits all(true, flags), expected_all(true, flags), closest(false, flags),
          expected_closest(false, flags);
      ours.ray(way, all);
      oracle.ray(way, expected_all);
      ours.ray(way, closest);
      oracle.ray(way, expected_closest);
      ASSERT_EQ(all.sorted(), expected_all.sorted()) << "ray " << i << ", flags " << flags;
      ASSERT_EQ(closest.found.size(), expected_closest.found.size());
      // Either of two hits at the same fraction may be the closest.
      ASSERT_EQ(closest.m_closestHitFraction, expected_closest.m_closestHitFraction) << "ray " << i;
      if (flags == 0) hits += closest.hasHit();
      all_hits += all.found.size();
    }
  }
  EXPECT_GT(hits, kRays * 3 / 10);
  EXPECT_LT(hits, kRays * 7 / 10);
  EXPECT_GT(all_hits, std::size_t(3 * hits));
}

TEST_P(Rays, closestAndAll_vs_bvhAndRaycast) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  BulletMesh source(shape.tree().mesh());
  const btBvhTriangleMeshShape bvh(source.view(), true);
  const Object ours(shape, btTransform::getIdentity()), stock(bvh, btTransform::getIdentity());
  std::mt19937_64 random(62);
  int hits = 0, at_rims = 0;
  constexpr int kRays = 3000;
  for (int i = 0; i < kRays; ++i) {
    const Way way = randomWay(random, scene);
    const unsigned flags = i % 2 ? unsigned(RayCallback::kF_FilterBackfaces) : 0u;
    RayHits closest(false, flags), expected(false, flags), all(true, flags), expected_all(true, flags);
    ours.ray(way, closest);
    stock.ray(way, expected);
    ours.ray(way, all);
    stock.ray(way, expected_all);
    ASSERT_EQ(closest.hasHit(), expected.hasHit()) << "ray " << i;
    ASSERT_NEAR(closest.m_closestHitFraction, expected.m_closestHitFraction, 1e-5) << "ray " << i;
    ASSERT_EQ(all.sorted(), expected_all.sorted()) << "ray " << i;
    hits += closest.hasHit();
    const std::optional<RayHit> exact =
        closestHit(shape.tree(), {way.from, way.to - way.from, 1.0, flags != 0});
    // Bullet's rays also hit within a rim of one part in ten thousand around a triangle.
    if (exact.has_value() != closest.hasHit() ||
        (exact && std::abs(exact->t - double(closest.m_closestHitFraction)) > 1e-4)) {
      ++at_rims;
    }
  }
  EXPECT_GT(hits, kRays * 3 / 10);
  EXPECT_LT(hits, kRays * 7 / 10);
  EXPECT_LE(at_rims, kRays / 500);
}

TEST_P(Rays, visitFewTriangles) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  struct Counting final : RayCallback {
    using RayCallback::RayCallback;
    void processTriangle(btVector3* triangle, int part, int index) override {
      ++visited;
      RayCallback::processTriangle(triangle, part, index);
    }
    btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
      ++hits;
      return all ? m_hitFraction : fraction;
    }
    int visited = 0, hits = 0;
    bool all = false;
  };
  std::mt19937_64 random(63);
  int closest_visited = 0, all_visited = 0, all_hits = 0, in_bounds = 0;
  constexpr int kRays = 500;
  for (int i = 0; i < kRays; ++i) {
    const Way way = randomWay(random, scene);
    btVector3 low = toBullet(way.from), high = low;
    low.setMin(toBullet(way.to));
    high.setMax(toBullet(way.to));
    Counting closest(toBullet(way.from), toBullet(way.to)), all = closest;
    all.all = true;
    shape.processAllTriangles(&closest, low, high);
    shape.processAllTriangles(&all, low, high);
    closest_visited += closest.visited;
    all_visited += all.visited;
    all_hits += all.hits;
    Generic generic(shape);
    Counting whole = closest;
    generic.processAllTriangles(&whole, low, high);
    in_bounds += generic.visited;
  }
  EXPECT_GT(in_bounds, 20 * closest_visited);
  EXPECT_LE(closest_visited, all_visited);
  EXPECT_LE(all_visited, all_hits + all_hits / 10);  // those in the rim
}

INSTANTIATE_TEST_SUITE_P(Scenes, Rays, ::testing::ValuesIn(scenes()), testing::nameOf);

TEST(Ray, throughTheWorld) {
  ClusteredOctreeShape shape = scenes()[0].shape();
  testing::BulletWorld world;
  world.add(shape, 0, testing::at(10, 0, 0));
  world.add(shape, 0, testing::at(20, 0, 0));
  const btVector3 from(0, 0, 0), to(40, 0, 0);
  btCollisionWorld::ClosestRayResultCallback closest(from, to);
  world->rayTest(from, to, closest);
  ASSERT_TRUE(closest.hasHit());
  EXPECT_NEAR(closest.m_hitPointWorld.x(), 10 - 2.7, 1e-2);
  EXPECT_NEAR(closest.m_hitNormalWorld.x(), -1, 5e-2);
  btCollisionWorld::AllHitsRayResultCallback all(from, to);
  world->rayTest(from, to, all);
  EXPECT_GE(all.m_hitFractions.size(), 8);
}

}  // namespace
}  // namespace octoblisk
