// Compares queries of many poses or rays on many threads with one query after another.
#include "octoblisk/batch.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "shared/meshes.h"

namespace octoblisk {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 8};

struct Batch : ::testing::Test {
  ClusteredOctree fan = ClusteredOctree::build(testing::fan(9, 8));
  ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 16, 10));
  std::vector<Pose> poses;

  Batch() {
    std::mt19937_64 random(95);
    const Pose start{Mat3::Identity(), Vec3(2.5, 0, 0)};
    for (int i = 0; i < 10 * static_cast<int>(kPosesAtOnce) + 17; ++i) {
      // Several pairs touch at once along this path, so the reported pair depends on the previous poses.
      const Eigen::AngleAxisd turn(0.003 * i, Vec3::UnitZ()), tilt(0.01 * i, Vec3(1, 2, 0).normalized());
      poses.push_back(Pose{turn.toRotationMatrix(), Vec3::Zero()} * start *
                      Pose{tilt.toRotationMatrix(), testing::randomPoint(random, 0.01)});
    }
  }
};

TEST_F(Batch, collideAll_vs_oneByOne) {
  const auto first = collideAll(fan, ring, poses, 1);
  ASSERT_EQ(first.size(), poses.size());
  std::size_t hits = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(first[i].has_value(), collide(fan, ring, poses[i]).has_value()) << i;
    hits += first[i].has_value();
  }
  EXPECT_GT(hits, poses.size() * 3 / 10);
  EXPECT_LT(hits, poses.size() * 7 / 10);
  for (const int threads : kThreadCounts) EXPECT_EQ(collideAll(fan, ring, poses, threads), first);
  EXPECT_EQ(collideAll(fan, ring, poses), first);
}

bool sameBits(const Clearance& one, const Clearance& other) {
  return std::memcmp(&one.distance, &other.distance, sizeof(double)) == 0 &&
         std::memcmp(one.point_on_a.data(), other.point_on_a.data(), 3 * sizeof(double)) == 0 &&
         std::memcmp(one.point_on_b.data(), other.point_on_b.data(), 3 * sizeof(double)) == 0 &&
         one.triangle_a == other.triangle_a && one.triangle_b == other.triangle_b;
}

TEST_F(Batch, distanceAll_vs_oneByOne) {
  for (const double bound : {std::numeric_limits<double>::infinity(), 0.05}) {
    const DistanceOptions options{.upper_bound = bound};
    const auto first = distanceAll(fan, ring, poses, options, 1);
    ASSERT_EQ(first.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i)
      ASSERT_NEAR(first[i].distance, distance(fan, ring, poses[i], options).distance, 1e-12) << i;
    for (const int threads : kThreadCounts) {
      const auto again = distanceAll(fan, ring, poses, options, threads);
      ASSERT_EQ(again.size(), first.size());
      for (std::size_t i = 0; i < first.size(); ++i)
        ASSERT_TRUE(sameBits(again[i], first[i])) << threads << " threads, pose " << i;
    }
  }
}

TEST_F(Batch, closestHitAll_vs_oneByOne) {
  std::mt19937_64 random(97);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    Ray ray{.origin = testing::randomPoint(random, 2.0)};
    ray.direction = testing::randomPoint(random, 1.0) - ray.origin;
    ray.t_max = i % 3 == 0 ? 0.5 : 10.0;
    ray.cull_back_faces = i % 2 == 0;
    if (i % 50 == 0) ray.origin.x() = std::numeric_limits<double>::quiet_NaN();
    if (i % 50 == 1) ray.origin.x() += 100.0;  // far beside the mesh
    rays.push_back(ray);
  }
  for (int i = 0; i < 100; ++i) {  // exact ties: through a vertex of several triangles
    const Vec3& vertex = fan.mesh().vertices()[static_cast<std::size_t>(i) % fan.mesh().vertices().size()];
    rays.push_back({.origin = vertex + Vec3(0.25, 0.5, 4.0), .direction = -Vec3(0.25, 0.5, 4.0)});
  }
  const auto all = closestHitAll(fan, rays, 1);
  ASSERT_EQ(all.size(), rays.size());
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto one = closestHit(fan, rays[i]);
    ASSERT_EQ(all[i].has_value(), one.has_value()) << i;
    if (!one) continue;
    ++hits;
    EXPECT_EQ(all[i]->t, one->t) << i;
    EXPECT_EQ(all[i]->triangle, one->triangle) << i;
    EXPECT_EQ(all[i]->point, one->point) << i;
    EXPECT_EQ(all[i]->normal, one->normal) << i;
    EXPECT_EQ(all[i]->back_face, one->back_face) << i;
  }
  EXPECT_GT(hits, rays.size() / 10);
  EXPECT_LT(hits, rays.size() * 9 / 10);
  const ClusteredOctree compact = ClusteredOctree::build(testing::fan(9, 8), {.storage = Storage::compact});
  const auto of_compact = closestHitAll(compact, rays, 1);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(of_compact[i].has_value(), all[i].has_value()) << i;
    if (all[i]) {
      ASSERT_EQ(of_compact[i]->triangle, all[i]->triangle) << i;
    }
  }
  for (const int threads : kThreadCounts) {
    const auto again = closestHitAll(fan, rays, threads);
    ASSERT_EQ(again.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(again[i].has_value(), all[i].has_value()) << threads << " threads, ray " << i;
      if (all[i]) {
        ASSERT_EQ(again[i]->t, all[i]->t) << threads << " threads, ray " << i;
      }
    }
  }
}

TEST_F(Batch, noPosesAndNoRays) {
  EXPECT_TRUE(closestHitAll(fan, {}, 8).empty());
  EXPECT_TRUE(collideAll(fan, ring, {}, 8).empty());
  EXPECT_TRUE(distanceAll(fan, ring, {}, {}, 8).empty());
}

}  // namespace
}  // namespace octoblisk
