// What queries count of their own work.
#include "octoblisk/query_cost.h"

#include <gtest/gtest.h>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

struct QueryCostTest : ::testing::Test {
  ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 10));
  ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
};

TEST_F(QueryCostTest, ofBodiesFarApartIsOneTest) {
  const QueryCost cost = costOfCollide(fan, ring, {Mat3::Identity(), Vec3(100, 0, 0)});
  EXPECT_EQ(cost.box_tests, 1u);
  EXPECT_EQ(cost.leaf_pairs, 0u);
  EXPECT_EQ(cost.triangle_tests, 0u);
  EXPECT_EQ(cost.exact_tests, 0u);
  EXPECT_EQ(cost.bytes(fan, ring), sizeof(Box8));
}

TEST_F(QueryCostTest, firstPairIsNoMoreWorkThanAllPairs) {
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
    EXPECT_LE(pairs.size(), all.triangle_tests * kLanes);  // the least that any method must look at
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

TEST_F(QueryCostTest, distanceMeasuresAtLeastThePairItNames) {
  const Pose pose{Mat3::Identity(), Vec3(4, 0, 0)};
  ASSERT_GT(distance(fan, ring, pose).distance, 0.0);
  const QueryCost cost = costOfDistance(fan, ring, pose);
  EXPECT_GE(cost.leaf_pairs, 1u);
  EXPECT_GE(cost.triangle_tests, 1u);
  EXPECT_GE(cost.exact_tests, 1u);
  EXPECT_LT(cost.triangle_tests, fan.stats().triangles * ring.stats().triangles / 100);
}

}  // namespace
}  // namespace octoblisk
