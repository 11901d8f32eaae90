// Penetration depths of the tool's parts in the blisk, as solids.
#include "grinding/part_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "demos/block.h"
#include "models/shared_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

/// The depths at one pose of a tool with one part.
std::vector<PartDepth> depthsOf(const TriangleMesh& blisk, const TriangleMesh& tool, const Pose& pose,
                                double limit) {
  return PartDepths(treeOf(blisk), {{"tool", treeOf(tool)}}, limit, 1).measure({&pose, 1}).front();
}

TEST(PartDepths, ofAFlatToolIsHowFarItIsPressedHoweverFineTheMeshesAre) {
  constexpr double kLimit = 0.1;
  for (const int steps : {1, 5, 20}) {
    for (const double pressed : {0.05, 0.2, 1.0, 3.0, 6.0, 9.0}) {
      const auto found = depthsOf(block({50, 50, 20}, steps), block({10, 10, 10}, steps + 1),
                                  at(60.0 - pressed, 0.3, 0.2), kLimit);
      ASSERT_EQ(found.size(), 1u);
      EXPECT_NEAR(found[0].depth, pressed, 0.01 * kLimit) << steps << " steps";
      EXPECT_FALSE(found[0].is_inside);
      EXPECT_NEAR(found[0].point_on_blisk.x(), 50.0, 1e-9) << "on the face that it is pressed into";
    }
  }
}

TEST(PartDepths, aBladeThinnerThanTheLimitIsNotCutThroughUnseen) {
  // The tool's own points are at most half a thickness deep; the edge inside it is deeper.
  const auto found = depthsOf(block({5, 0.05, 5}, 10), block({3, 2, 2}, 4), at(7.0, 0.013, 0.1), 0.1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GE(found[0].depth, 0.9);
  EXPECT_LE(found[0].depth, 1.0);
  EXPECT_NEAR(found[0].point_on_blisk.x(), 5.0, 0.1);
}

TEST(PartDepths, ofAPartWhollyInsideOrRoundTheBlisk) {
  for (const double limit : {0.0, 0.1}) {
    const auto inside = depthsOf(block({50, 50, 20}, 8), block({2, 2, 2}, 2), at(10, 0, 13), limit);
    ASSERT_EQ(inside.size(), 1u);
    EXPECT_TRUE(inside[0].is_inside);
    EXPECT_NEAR(inside[0].depth, 9.0, 1e-3) << "depth of the lower face";
    const auto round = depthsOf(*testing::torus(10, 2, 64, 32), block({50, 50, 20}, 1), at(0, 0, 0), limit);
    ASSERT_EQ(round.size(), 1u);
    EXPECT_TRUE(round[0].is_inside);
    EXPECT_GT(round[0].depth, 19.0);
    EXPECT_TRUE(depthsOf(block({50, 50, 20}, 8), block({2, 2, 2}, 2), at(80, 0, 0), limit).empty());
  }
}

TEST(PartDepths, ofOpenMeshes) {
  const auto sheet = testing::waveSheet(1.0, 0.1, 8);
  const TriangleMesh box = block({0.5, 0.5, 0.5}, 2);
  const auto kindOf = [](const TriangleMesh& blisk, const TriangleMesh& tool) {
    return PartDepths(treeOf(blisk), {{"tool", treeOf(tool)}}, 0.1, 1).kindOf(0);
  };
  EXPECT_EQ(kindOf(box, box), DepthKind::of_solids);
  EXPECT_EQ(kindOf(box, *sheet), DepthKind::of_part);
  // A sheet bounds no solid, wherever it is touched.
  const auto in_sheet = depthsOf(*sheet, box, at(0, 0, 0.3), 0.1);
  ASSERT_EQ(in_sheet.size(), 1u);
  EXPECT_FALSE(in_sheet[0].is_known);
  const auto at_its_edge = depthsOf(*sheet, box, at(1.4, 0, 0.55), 0.1);
  ASSERT_EQ(at_its_edge.size(), 1u);
  EXPECT_FALSE(at_its_edge[0].is_known);
  const auto found = depthsOf(box, *sheet, at(0, 0, 0.3), 0.1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_GT(found[0].depth, 0.1);
  EXPECT_LT(found[0].depth, 0.3);
}

constexpr double kSpacing = 0.02;

/// The greatest depth in the tool over a grid of points on the blisk's surface.
double deepestSample(const TriangleMesh& blisk, const octoblisk::Surface& tool, const Pose& blisk_in_tool) {
  double deepest = 0.0;
  for (std::size_t t = 0; t < blisk.triangleCount(); ++t) {
    const auto [a, b, c] = blisk_in_tool * blisk.triangle(t);
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const int steps = 1 + static_cast<int>(longest / kSpacing);
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 point = a + (b - a) * i / steps + (c - a) * j / steps;
        if ((point.cwiseAbs() - tool.tree().mesh().bounds().halfExtents()).maxCoeff() > 0.0) continue;
        if (locate(tool, point) != PointLocation::inside) continue;
        deepest = std::max(deepest, closestPoint(tool.tree(), point)->distance);
      }
    }
  }
  return deepest;
}

TEST(PartDepths, isTheGreaterOfBothWays_vs_depths_of_a_grid_of_points) {
  constexpr double kLimit = 0.05;
  constexpr int kPoses = 60;
  const std::shared_ptr<const TriangleMesh> blisks[] = {
      testing::torus(1.0, 0.3, 16, 8),                                    // every edge is sharp
      testing::torus(1.0, 0.3, 96, 64),                                   // none is
      std::make_shared<const TriangleMesh>(block({1.2, 0.8, 0.04}, 6))};  // thin
  const auto tool = treeOf(block({0.3, 0.2, 0.1}, 3));
  const octoblisk::Surface tool_surface(*tool);
  std::mt19937_64 random(61);
  int deep = 0, of_blisks = 0;
  for (const auto& blisk : blisks) {
    const auto tree = treeOf(*blisk);
    const octoblisk::Surface surface(*tree);
    std::vector<Pose> poses;
    while (std::ssize(poses) < kPoses) {
      // From a touch to slightly deeper: most poses are near the limit.
      Pose pose = testing::randomPose(random, 1.3);
      const Clearance apart = distance(*tree, *tool, pose);
      if (apart.distance <= 0.0) continue;
      const Vec3 towards = (apart.point_on_a - apart.point_on_b).normalized();
      pose.translation += (apart.distance + testing::uniform(random, 0.0, 3.0 * kLimit)) * towards;
      poses.push_back(pose);
    }
    PartDepths one(tree, {{"tool", tool}}, kLimit, 1), three(tree, {{"tool", tool}}, kLimit, 3);
    const auto found = one.measure(poses), again = three.measure(poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      ASSERT_EQ(found[i].size(), 1u);
      ASSERT_EQ(found[i][0].depth, again[i][0].depth);
      const Pose blisk_in_tool = poses[i].inverse();
      const double of_tool = deepestSample(tool->mesh(), surface, poses[i]);
      const double of_blisk = deepestSample(*blisk, tool_surface, blisk_in_tool);
      const double greater = std::max(of_tool, of_blisk);
      EXPECT_GE(found[i][0].depth, greater - 0.01 * kLimit) << "pose " << i;
      EXPECT_LE(found[i][0].depth, greater + kSpacing) << "pose " << i;
      deep += found[i][0].depth > kLimit;
      if (of_blisk < of_tool + kSpacing) continue;
      ++of_blisks;  // then the deepest point is the blisk's
      const Vec3 point = blisk_in_tool * found[i][0].point_on_blisk;
      EXPECT_EQ(locate(tool_surface, point), PointLocation::inside);
      EXPECT_NEAR(closestPoint(*tool, point)->distance, found[i][0].depth, 1e-12);
    }
  }
  EXPECT_GT(deep, std::ssize(blisks) * kPoses * 3 / 10);
  EXPECT_LT(deep, std::ssize(blisks) * kPoses * 7 / 10);
  EXPECT_GT(of_blisks, kPoses / 10);
}

TEST(PartDepths, rememberedAreThoseOfThePartAtThePose) {
  const auto wall = treeOf(block({40, 2, 40}, 1)), small = treeOf(block({2, 2, 2}, 1));
  const std::vector<ToolPart> parts = {{"large", treeOf(block({4, 2, 4}, 1))}, {"small", small}};
  std::vector<Pose> poses(3);
  poses[0].translation = {0, 1.95, 0};
  poses[1].translation = {0, 1.97, 0};
  poses[2].translation = {0, 9, 0};
  PartDepths fresh(wall, parts, 0.1, 1), remembering(wall, parts, 0.1, 2);
  remembering.remember();
  const std::vector<std::size_t> one = {1};
  EXPECT_TRUE(remembering.measure(one, {&poses[1], 1}).front());
  for (int time = 0; time < 2; ++time) {
    const auto expected = fresh.measure(poses), found = remembering.measure(poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      ASSERT_EQ(found[i].size(), expected[i].size());
      for (std::size_t k = 0; k < found[i].size(); ++k) {
        EXPECT_EQ(found[i][k].part, expected[i][k].part);
        EXPECT_EQ(found[i][k].depth, expected[i][k].depth);
        EXPECT_EQ(found[i][k].triangle_of_blisk, expected[i][k].triangle_of_blisk);
      }
    }
    EXPECT_EQ(found[0].size(), 2u);
    EXPECT_TRUE(found[2].empty());
  }
}

}  // namespace
}  // namespace octoblisk::demos
