// The costs that queries count.
#include "query_cost.h"

#include <gtest/gtest.h>

#include <random>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "shared/meshes.h"
#include "simd/box8.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

struct QueryCosts : ::testing::Test {
  ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
};

TEST_F(QueryCosts, ofBodiesFarApartIsOneTest) {
  const QueryCost cost = costOfCollide(fan, ring, {Mat3::Identity(), Vec3(100, 0, 0)});
  EXPECT_EQ(cost.box_tests, 1u);
  EXPECT_EQ(cost.leaf_pairs, 0u);
  EXPECT_EQ(cost.triangle_tests, 0u);
  EXPECT_EQ(cost.exact_tests, 0u);
  EXPECT_EQ(cost.bytes(fan, ring), sizeof(Box8));
}

TEST_F(QueryCosts, firstPairIsNoMoreWorkThanAllPairs) {
  std::mt19937_64 random(77);
  std::vector<TrianglePair> pairs;
  std::size_t hits = 0, less = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.3);
    const QueryCost first = costOfCollide(fan, ring, pose), all = costOfTouchingPairs(fan, ring, pose);
    touchingPairs(fan, ring, pose, pairs);
    EXPECT_LE(first.box_tests, all.box_tests);
    EXPECT_LE(first.leaf_pairs, all.leaf_pairs);
    EXPECT_LE(first.triangle_tests, all.triangle_tests);
    EXPECT_LE(first.exact_tests, all.exact_tests);
    EXPECT_LE(pairs.size(), all.triangle_tests * kLanes);  // any method must look at these
    if (pairs.empty()) {
      EXPECT_EQ(first.box_tests, all.box_tests);
      continue;
    }
    ++hits;
    less += first.box_tests < all.box_tests;
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
  EXPECT_GT(less, hits / 2);
}

TEST_F(QueryCosts, distanceMeasuresAtLeastThePairItNames) {
  const Pose pose{Mat3::Identity(), Vec3(4, 0, 0)};
  ASSERT_GT(distance(fan, ring, pose).distance, 0.0);
  const QueryCost cost = costOfDistance(fan, ring, pose);
  EXPECT_GE(cost.leaf_pairs, 1u);
  EXPECT_GE(cost.triangle_tests, 1u);
  EXPECT_GE(cost.exact_tests, 1u);
  EXPECT_LT(cost.triangle_tests, fan.stats().triangles * ring.stats().triangles / 100);
}

TEST_F(QueryCosts, rayThatPassesByCostsNothing) {
  Ray ray;
  ray.origin = Vec3(0, 0, 100);
  ray.direction = Vec3(1, 0, 0);
  const QueryCost cost = costOfClosestHit(ring, ray);
  EXPECT_EQ(cost.box_tests, 0u);
  EXPECT_EQ(cost.bytes(ring), 0u);
}

TEST_F(QueryCosts, rayMeasuresTheTriangleItNamesAndFewOthers) {
  std::mt19937_64 random(78);
  std::normal_distribution<double> somewhere(0.0, 0.3);
  const auto point = [&] { return Vec3{somewhere(random), somewhere(random), somewhere(random)}; };
  std::size_t hits = 0, exact_tests = 0;
  constexpr int kRays = 500;
  for (int i = 0; i < kRays; ++i) {
    Ray ray;
    ray.origin = point();
    ray.direction = point();
    const QueryCost cost = costOfClosestHit(ring, ray);
    const bool hit = closestHit(ring, ray).has_value();
    hits += hit;
    exact_tests += cost.exact_tests;
    EXPECT_EQ(cost.triangle_tests, cost.leaf_pairs);
    EXPECT_GE(cost.box_tests, cost.leaf_pairs > 0 ? 1u : 0u);
    if (!hit) continue;
    EXPECT_GE(cost.leaf_pairs, 1u);
    EXPECT_GE(cost.exact_tests, 1u);
    EXPECT_GE(cost.bytes(ring), sizeof(Box8));
  }
  EXPECT_GT(hits, kRays * 3 / 10u);
  EXPECT_LT(hits, kRays * 7 / 10u);
  EXPECT_LT(exact_tests, hits * 3);  // of 480 triangles
}

}  // namespace
}  // namespace octoblisk::bench
