#include "build/paper/part_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "build/paper/k_means.h"
#include "build/paper/k_opt.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

constexpr int kNumbers[] = {7, -1, 3, 0, 5};  // of parts

struct Points {
  explicit Points(std::size_t count) {
    std::mt19937_64 random(91);
    for (std::size_t i = 0; i < count; ++i) {
      centroids.push_back(testing::randomPoint(random, 10));
      parts.push_back(kNumbers[random() % std::size(kNumbers)]);
    }
  }
  std::vector<Vec3> centroids;
  std::vector<int> parts;
};

TEST(PartClusters, everyTriangleIsOnceInAClusterOfItsPart) {
  const Points points(1000);
  for (std::size_t k = 1; k <= 8; ++k) {
    const auto parts =
        partClusters(points.centroids, {.clusters = k, .seed = k, .part_of_triangle = points.parts});
    ASSERT_EQ(parts.size(), std::size(kNumbers));
    std::set<std::uint32_t> seen;
    const std::set<int> numbers(std::begin(kNumbers), std::end(kNumbers));
    auto number = numbers.begin();  // ascending
    for (const std::vector<TriangleSet>& part : parts) {
      EXPECT_EQ(part.size(), k);
      for (const TriangleSet& cluster : part) {
        EXPECT_TRUE(std::ranges::is_sorted(cluster));
        for (const std::uint32_t t : cluster) {
          EXPECT_EQ(points.parts[t], *number);
          EXPECT_TRUE(seen.insert(t).second) << t;
        }
      }
      ++number;
    }
    EXPECT_EQ(seen.size(), points.centroids.size());
  }
}

TEST(PartClusters, withoutAKEachPartHasItsBest) {
  const Points points(600);
  constexpr std::size_t kFnop = 20;
  const auto parts = partClusters(points.centroids,
                                  {.clusters = 0, .part_of_triangle = points.parts, .leaf_capacity = kFnop});
  const std::set<int> numbers(std::begin(kNumbers), std::end(kNumbers));
  ASSERT_EQ(parts.size(), numbers.size());
  std::set<std::size_t> found;
  auto part = parts.begin();
  for (const int number : numbers) {
    std::vector<Vec3> alone;
    for (std::size_t t = 0; t < points.parts.size(); ++t) {
      if (points.parts[t] == number) alone.push_back(points.centroids[t]);
    }
    EXPECT_EQ(part->size(), optimalK(alone, {.leaf_capacity = kFnop}));
    found.insert((part++)->size());
  }
  EXPECT_GT(found.size(), 1u) << "not all the same";
  const std::vector<Vec3> one = {Vec3::Zero()};
  EXPECT_EQ(partClusters(one, {.clusters = 0}).front().size(), 1u);
}

TEST(PartClusters, clustersAreThoseOfThePartByItself) {
  const Points points(300);
  const auto parts = partClusters(points.centroids, {.clusters = 4, .part_of_triangle = points.parts});
  std::vector<Vec3> alone;
  TriangleSet triangles;
  for (std::uint32_t t = 0; t < points.parts.size(); ++t) {
    if (points.parts[t] != -1) continue;
    alone.push_back(points.centroids[t]);
    triangles.push_back(t);
  }
  const Clustering clustering = kMeans(alone, {.k = 4});
  std::vector<TriangleSet> expected(4);
  for (std::size_t i = 0; i < alone.size(); ++i)
    expected[clustering.cluster_of_point[i]].push_back(triangles[i]);
  EXPECT_EQ(parts[0], expected);
}

TEST(PartClusters, aSmallPartHasAsManyAsItHasTriangles) {
  const std::vector<Vec3> centroids = {{0, 0, 0}, {1, 0, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}};
  const auto parts = partClusters(centroids, {.clusters = 3, .part_of_triangle = {2, 1, 2, 2, 2}});
  ASSERT_EQ(parts.size(), 2u);
  ASSERT_EQ(parts[0].size(), 1u);
  EXPECT_EQ(parts[0][0], TriangleSet({1}));
  EXPECT_EQ(parts[1].size(), 3u);
  const std::vector<Vec3> same(4, Vec3(1, 2, 3));
  const auto of_same = partClusters(same, {.clusters = 3});
  for (const TriangleSet& cluster : of_same.front()) EXPECT_FALSE(cluster.empty());
}

TEST(PartClusters, refusesBadOptions) {
  const std::vector<Vec3> centroids(3, Vec3::Zero());
  EXPECT_THROW(partClusters(centroids, {.part_of_triangle = {1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
