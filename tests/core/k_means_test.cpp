#include "build/paper/k_means.h"

#include <gtest/gtest.h>

#include <numeric>

#include "build/paper/k_opt.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

std::vector<Vec3> randomPoints(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(testing::randomPoint(random, 10));
  return points;
}

/// The least S(C) over all assignments of n points to k clusters.
double leastSquaredError(const std::vector<Vec3>& points, std::size_t k) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> cluster(points.size(), 0);
  while (true) {
    double error = 0.0;
    for (std::size_t c = 0; c < k; ++c) {
      Vec3 sum = Vec3::Zero();
      double squares = 0.0, count = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (cluster[i] != c) continue;
        sum += points[i];
        squares += points[i].squaredNorm();
        ++count;
      }
      if (count > 0) error += squares - sum.squaredNorm() / count;
    }
    least = std::min(least, error);
    std::size_t digit = 0;
    while (digit < points.size() && ++cluster[digit] == k) cluster[digit++] = 0;
    if (digit == points.size()) return least;
  }
}

TEST(KMeans, oftenReachesTheOptimumOfAllAssignmentsAndNeverPassesIt) {
  int optimal = 0, optimal_of_16 = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::vector<Vec3> points = randomPoints(seed, 8);
    const double least = leastSquaredError(points, 3),
                 found = kMeans(points, {.k = 3, .seed = seed, .starts = 1}).squared_error;
    const double best_found = kMeans(points, {.k = 3, .seed = seed}).squared_error;
    EXPECT_GE(found, least * (1 - 1e-12));
    optimal += found <= least * (1 + 1e-9);
    optimal_of_16 += best_found <= least * (1 + 1e-9);
  }
  EXPECT_GE(optimal, 15);
  EXPECT_GE(optimal_of_16, 90);
}

TEST(KMeans, endsInAFixedPointOfStepsTwoAndThree) {
  for (std::size_t k = 1; k <= 9; ++k) {
    const std::vector<Vec3> points = randomPoints(k, 500);
    const Clustering clustering = kMeans(points, {.k = k, .seed = k});
    ASSERT_TRUE(clustering.converged);
    std::vector<Vec3> sum(k, Vec3::Zero());
    double error = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::uint32_t own = clustering.cluster_of_point[i];
      for (std::size_t c = 0; c < k; ++c) {
        EXPECT_LE((points[i] - clustering.centers[own]).norm(),
                  (points[i] - clustering.centers[c]).norm() + 1e-12);
      }
      sum[own] += points[i];
      error += (points[i] - clustering.centers[own]).squaredNorm();
    }
    for (std::size_t c = 0; c < k; ++c) {
      EXPECT_TRUE(clustering.centers[c].isApprox(sum[c] / clustering.sizes[c], 1e-12));
    }
    EXPECT_NEAR(clustering.squared_error, error, 1e-9 * error);
    EXPECT_EQ(std::accumulate(clustering.sizes.begin(), clustering.sizes.end(), 0u), points.size());
  }
}

TEST(KMeans, sameSeedSameBitsOtherSeedOtherStart) {
  const std::vector<Vec3> points = randomPoints(1, 300);
  const Clustering a = kMeans(points, {.k = 7, .seed = 3}), b = kMeans(points, {.k = 7, .seed = 3});
  EXPECT_EQ(a.cluster_of_point, b.cluster_of_point);
  EXPECT_EQ(a.squared_error, b.squared_error);
  EXPECT_NE(a.cluster_of_point, kMeans(points, {.k = 7, .seed = 4}).cluster_of_point);
}

TEST(KMeans, theBestOfSeveralStartsCounts) {
  int better = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Vec3> points = randomPoints(seed, 200);
    const Clustering one = kMeans(points, {.k = 6, .seed = seed, .starts = 1});
    const Clustering best = kMeans(points, {.k = 6, .seed = seed});
    EXPECT_LE(best.squared_error, one.squared_error);
    better += best.squared_error < 0.999 * one.squared_error;
    // A run with more starts repeats the starts of a run with fewer.
    EXPECT_LE(kMeans(points, {.k = 6, .seed = seed, .starts = 64}).squared_error, best.squared_error);
  }
  EXPECT_GT(better, 5);
}

TEST(KMeans, theMeansOfAConvergedRunAreAFixedPointWhichIsThePapersStart) {
  const std::vector<Vec3> points = randomPoints(1, 300);
  const Clustering run = kMeans(points, {.k = 5, .starts = 1});
  ASSERT_TRUE(run.converged);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Vec3& center : run.centers) {
      EXPECT_LE((points[i] - run.centers[run.cluster_of_point[i]]).norm(), (points[i] - center).norm());
    }
  }
}

TEST(KMeans, kFromOneToN) {
  const std::vector<Vec3> points = randomPoints(2, 12);
  EXPECT_NEAR(kMeans(points, {.k = 12}).squared_error, 0.0, 1e-20);
  EXPECT_THROW(kMeans(points, {.k = 13}), std::invalid_argument);
  EXPECT_THROW(kMeans(points, {.k = 0}), std::invalid_argument);
  EXPECT_THROW(kMeans(points, {.starts = 0}), std::invalid_argument);
}

TEST(KMeans, duplicatePointsLeaveClustersEmptyAndEnd) {
  const std::vector<Vec3> points(10, Vec3(1, 2, 3));
  const Clustering clustering = kMeans(points, {.k = 4});
  EXPECT_TRUE(clustering.converged);
  EXPECT_EQ(clustering.sizes, (std::vector<std::uint32_t>{10, 0, 0, 0}));  // ties go to the lowest cluster
}

TEST(KMeans, anEmptyClusterTakesTheFarthestPoint) {
  std::vector<Vec3> points(20, Vec3::Zero());  // most random seeds draw the origin twice
  points.push_back({1, 0, 0});
  points.push_back({0, 5, 0});
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_NEAR(kMeans(points, {.k = 3, .seed = seed}).squared_error, 0.0, 1e-20) << seed;
  }
}

TEST(KOpt, prefersTheNumberOfClumps) {
  std::mt19937_64 random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 600; ++i)
    points.push_back(Vec3(100.0 * (i % 3), 70.0 * (i % 3 == 1), 0) + testing::randomPoint(random, 1));
  // One of two clusters spans the gap between clumps, and is divided; each of more clusters is a leaf.
  EXPECT_EQ(optimalK(points, {.leaf_capacity = 200}), 3u);
}

TEST(KOpt, refusesAKOutOfRange) {
  const std::vector<Vec3> points = randomPoints(5, 400);
  EXPECT_THROW(optimalK(points, {.k_max = 1}), std::invalid_argument);
  EXPECT_THROW(optimalK(points, {.k_max = 401}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
