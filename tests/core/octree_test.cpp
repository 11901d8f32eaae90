#include "build/paper/octree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

/// Counts splits by plain recursion over copies of the points.
std::size_t bruteForceSplits(const std::vector<Vec3>& points, const Vec3& low, const Vec3& high,
                             std::size_t capacity, int depth) {
  if (points.size() <= capacity || depth == 0) return 0;
  const Vec3 middle = 0.5 * (low + high);
  std::size_t splits = 1;
  for (int octant = 0; octant < 8; ++octant) {
    std::vector<Vec3> inside;
    Vec3 from = low, to = high;
    for (int k = 0; k < 3; ++k) (octant & 1 << k ? from : to)[k] = middle[k];
    for (const Vec3& p : points) {
      bool in = true;
      for (int k = 0; k < 3; ++k) in &= (p[k] >= middle[k]) == ((octant & 1 << k) != 0);
      if (in) inside.push_back(p);
    }
    splits += bruteForceSplits(inside, from, to, capacity, depth - 1);
  }
  return splits;
}

TEST(Octree, countsNodesAsBruteForceDoes) {
  std::mt19937_64 random(9);
  for (const std::size_t capacity : {1u, 2u, 5u, 10u}) {
    std::vector<Vec3>
        points;  // integers in [0, 64] that include the corners, so points lie exactly on boundaries
    for (int i = 0; i < 700; ++i) points.push_back((testing::randomPoint(random, 32).array() + 32).floor());
    points.push_back(Vec3::Zero());
    points.push_back(Vec3::Constant(64));
    const Octree octree = Octree::build(points, {.leaf_capacity = capacity});
    EXPECT_EQ(octree.stats().total_nodes, 1 + 8 * bruteForceSplits(points, Vec3::Zero(), Vec3::Constant(64),
                                                                   capacity, Octree::kMaxDepth));
  }
}

TEST(Octree, everyPointIsInOneLeafThatHoldsIt) {
  std::mt19937_64 random(10);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i)
    points.push_back(testing::randomPoint(random, 5).cwiseProduct(Vec3(1, 0.2, 0.01)));
  const Octree octree = Octree::build(points, {.leaf_capacity = 3, .axes = testing::randomRotation(random)});
  std::vector<int> seen(points.size(), 0);
  double leaf_volume = 0.0;
  std::size_t leaves = 0;
  for (const Octree::Node& node : octree.nodes()) {
    if (!node.isLeaf() || node.count() == 0) continue;
    ++leaves;
    leaf_volume += octree.cell(node).volume();
    EXPECT_LE(node.count(), 3u);
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      ++seen[octree.order()[i]];
      EXPECT_TRUE(octree.cell(node).contains(points[octree.order()[i]], 1e-12));
    }
  }
  EXPECT_TRUE(std::ranges::all_of(seen, [](int count) { return count == 1; }));
  EXPECT_EQ(octree.stats().non_empty_leaves, leaves);
  EXPECT_NEAR(octree.stats().leaf_volume, leaf_volume, 1e-9 * leaf_volume);
}

TEST(Octree, duplicatePointsEndAtTheDepthCap) {
  const std::vector<Vec3> points(5, Vec3(1, 2, 3));
  const Octree octree = Octree::build(points, {.leaf_capacity = 2});
  EXPECT_EQ(octree.stats().depth, 32);
  EXPECT_EQ(octree.stats().total_nodes, 1u + 8u * 32u);
}

TEST(Octree, aCubicRootIsACube) {
  const std::vector<Vec3> points = {{0, 0, 0}, {4, 1, 2}};
  const Octree cubic = Octree::build(points, {.leaf_capacity = 8, .cubic = true});
  EXPECT_DOUBLE_EQ(cubic.stats().root_volume, 64.0);
  EXPECT_DOUBLE_EQ(Octree::build(points, {.leaf_capacity = 8}).stats().root_volume, 8.0);
}

TEST(Octree, refusesBadOptions) {
  const std::vector<Vec3> points = {{0, 0, 0}};
  EXPECT_THROW(Octree::build({}), std::invalid_argument);
  EXPECT_THROW(Octree::build(points, {.leaf_capacity = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
