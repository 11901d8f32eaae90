// Tests clusters at a depth of the tree against a box and against another tree's clusters. They are never
// apart if triangles are near, and near only if boxes of that depth are.
#include "query/clusters_near.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "octoblisk/distance.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

ClusteredOctree built(const testing::SharedMesh& mesh, Storage storage = Storage::full) {
  return ClusteredOctree::build(mesh, {.storage = storage});
}

/// The widest gap between two boxes along their six face axes, in double precision.
double widestFaceGap(const Obb& a, const Obb& b) {
  double widest = -std::numeric_limits<double>::infinity();
  for (const Mat3* axes : {&a.axes, &b.axes}) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 axis = axes->col(i);
      const double radius = (a.axes.transpose() * axis).cwiseAbs().dot(a.half_extents) +
                            (b.axes.transpose() * axis).cwiseAbs().dot(b.half_extents);
      widest = std::max(widest, std::abs(axis.dot(a.center - b.center)) - radius);
    }
  }
  return widest;
}

double leastGap(const std::vector<Obb>& some, const std::vector<Obb>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Obb& a : some) {
    for (const Obb& b : others) least = std::min(least, widestFaceGap(a, b));
  }
  return least;
}

class ClustersNear : public ::testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(fastAndCompact, ClustersNear, ::testing::Values(Storage::full, Storage::compact));

TEST_P(ClustersNear, missesNoPairOfTreesAndInventsNone) {
  const ClusteredOctree a = built(testing::fan(5, 8), GetParam());
  const ClusteredOctree b = built(testing::torus(0.6, 0.2, 24, 12), GetParam());
  std::mt19937_64 random(71);
  constexpr int kCases = 300;
  for (const int depth : {0, 1, 2, 3, ClusteredOctree::kMaxDepth}) {
    const std::vector<Obb> boxes_of_a = a.boxes(depth), boxes_of_b = b.boxes(depth);
    int are_near = 0, touch = 0;
    for (int i = 0; i < kCases; ++i) {
      const Pose b_in_a = testing::randomPose(random, 1.9);
      const double reach = i % 2 == 0 ? 0.0 : uniform(random, 0.0, 0.3);
      const bool near = clustersNear(a, b, b_in_a, reach, depth);
      const bool within = distance(a, b, b_in_a, {.upper_bound = reach + 1e-9}).found();
      ASSERT_TRUE(near || !within) << "case " << i << ", depth " << depth;
      std::vector<Obb> posed;
      for (const Obb& box : boxes_of_b) posed.push_back(b_in_a * box);
      if (near) {
        ASSERT_LE(leastGap(boxes_of_a, posed), reach + 1e-4) << "case " << i << ", depth " << depth;
      }
      are_near += near;
      touch += within;
    }
    EXPECT_GT(touch, kCases * 3 / 10);
    EXPECT_GT(kCases - touch, kCases * 3 / 10);
    EXPECT_GE(are_near, touch);
  }
}

TEST_P(ClustersNear, missesNoBoxAndInventsNone) {
  const ClusteredOctree tree = built(testing::torus(2, 0.5, 32, 16), GetParam());
  std::mt19937_64 random(74);
  constexpr int kCases = 300;
  std::map<int, std::vector<Obb>> boxes;
  for (const int depth : {0, 1, 2, 3, ClusteredOctree::kMaxDepth}) boxes[depth] = tree.boxes(depth);
  int near_at_root = 0, near_deep = 0;
  for (int i = 0; i < kCases; ++i) {
    const Pose pose = testing::randomPose(random, 2.6);
    const Obb box{pose.translation, pose.rotation,
                  Vec3{uniform(random, 0.1, 0.7), uniform(random, 0.1, 0.7), uniform(random, 0.1, 0.7)}};
    const double reach = i % 2 == 0 ? 0.0 : uniform(random, 0.0, 0.2);
    const ClusteredOctree solid = built(testing::boxMesh(box.half_extents));
    const bool within = distance(tree, solid, pose, {.upper_bound = reach + 1e-9}).found();
    for (const int depth : {0, 1, 2, 3, ClusteredOctree::kMaxDepth}) {
      const bool near = clustersNear(tree, box, reach, depth);
      ASSERT_TRUE(near || !within) << "case " << i << ", depth " << depth;
      if (near) {
        ASSERT_LE(leastGap(boxes[depth], {box}), reach + 1e-4) << "case " << i;
      }
      near_at_root += near && depth == 0;
      near_deep += near && depth == 3;
    }
  }
  EXPECT_GT(near_deep, kCases * 3 / 10);
  EXPECT_LT(near_deep, kCases * 7 / 10);
  EXPECT_GT(near_at_root, near_deep + kCases / 10);
}

TEST(ClustersNear, aSphereInTheHoleOfATorusIsNearItsRootAlone) {
  const ClusteredOctree torus = built(testing::torus(2, 0.5, 48, 24));
  const Obb box{Vec3::Zero(), Mat3::Identity(), Vec3::Constant(0.5)};
  EXPECT_TRUE(clustersNear(torus, box, 0.0, 0));
  EXPECT_TRUE(clustersNear(torus, box, 0.0, -1));
  EXPECT_FALSE(clustersNear(torus, box, 0.0, 2));
  EXPECT_TRUE(clustersNear(torus, box, 1.1, 2));
}

TEST(ClustersNear, nothingIsNearWhatIsNotFinite) {
  const ClusteredOctree torus = built(testing::torus(2, 0.5, 24, 12));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(clustersNear(torus, {Vec3::Constant(nan), Mat3::Identity(), Vec3::Ones()}, 0.0, 2));
  EXPECT_FALSE(clustersNear(torus, torus, {Mat3::Constant(nan), Vec3::Zero()}, 0.0, 2));
  EXPECT_FALSE(clustersNear(torus, torus, {Mat3::Identity(), Vec3::Constant(nan)}, 0.0, 2));
}

}  // namespace
}  // namespace octoblisk
