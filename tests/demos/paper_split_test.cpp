// Tables 1 and 2 of the paper: their definitions, and the published numbers.
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <vector>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"
#include "geometry/separating_axis.h"
#include "paper/belt_poses.h"
#include "paper/published.h"
#include "paper/segmentation.h"
#include "paper/split_experiment.h"
#include "paper/split_run.h"
#include "paper/surface_points.h"
#include "shared/meshes.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

const Progress kSilent = [](double) {};

/// The corners of two unit cubes, at 0 and at 100.
Points twoCubes() {
  Points points;
  for (const double at : {0.0, 100.0}) {
    for (int corner = 0; corner < 8; ++corner) {
      points.emplace_back(at + (corner & 1), at + (corner >> 1 & 1), at + (corner >> 2));
    }
  }
  return points;
}

TEST(Segmentation, nodesAreKPlusEightForEachSplit) {
  const Points points = twoCubes();
  // Each cluster is one cube: one split separates its eight corners.
  const Segmentation improved(clustersOf(points, {.k = 2}), 1, CellFrame::cube);
  EXPECT_EQ(improved.totalNodes(), 2u + 8u * 2u);
  EXPECT_DOUBLE_EQ(improved.leafVolume(), 2.0);
  EXPECT_DOUBLE_EQ(improved.rootVolume(), 2.0);
  // The root has sides of 101: one split separates the cubes. Then cells of 101/2, 101/4, … 101/64 at each
  // cube are divided; the last one, whose middle is inside the cube, separates the corners.
  const Segmentation traditional(clustersOf(points, {.k = 0}), 1, CellFrame::cube);
  EXPECT_EQ(traditional.totalNodes(), 1u + 8u * (1u + 6u + 6u));
  EXPECT_NEAR(traditional.leafVolume(), 16.0 * std::pow(101.0 / 128.0, 3), 1e-9);
  // Eight points are not divided at FNOP 8.
  EXPECT_EQ(Segmentation(clustersOf(points, {.k = 2}), 8, CellFrame::cube).totalNodes(), 2u);
  EXPECT_EQ(Segmentation(clustersOf(points, {.k = 0}), 8, CellFrame::cube).totalNodes(), 1u + 8u);
}

TEST(Segmentation, framesOfCells) {
  Points bar;  // along (1, 1, 0)
  for (int i = 0; i <= 10; ++i) {
    for (const double side : {-0.5, 0.5}) bar.emplace_back(i - side, i + side, 0.1 * side);
  }
  const auto rootOf = [&](CellFrame frame) {
    return Segmentation(std::span(&bar, 1), 100, frame).rootVolume();
  };
  EXPECT_NEAR(rootOf(CellFrame::cube), 11.0 * 11.0 * 11.0, 1e-9);
  EXPECT_NEAR(rootOf(CellFrame::box), 11.0 * 11.0 * 0.1, 1e-9);
  EXPECT_LT(rootOf(CellFrame::principal_box), 0.2 * rootOf(CellFrame::box));
}

/// Counts directly by the definition: a cell with more points than FNOP has eight children.
std::size_t nodesOf(const Points& points, const Vec3& low, double side, std::size_t fnop) {
  if (points.size() <= fnop) return 1;
  std::array<Points, 8> parts;
  const double half = 0.5 * side;
  for (const Vec3& point : points) {
    std::size_t part = 0;
    for (int axis = 0; axis < 3; ++axis) part += point[axis] >= low[axis] + half ? std::size_t{1} << axis : 0;
    parts[part].push_back(point);
  }
  std::size_t count = 1;
  for (std::size_t part = 0; part < 8; ++part) {
    Vec3 corner = low;
    for (int axis = 0; axis < 3; ++axis) corner[axis] += (part >> axis & 1) != 0 ? half : 0.0;
    count += nodesOf(parts[part], corner, half, fnop);
  }
  return count;
}

std::size_t nodesOf(const Points& points, std::size_t fnop) {
  const Obb box = boundingBox(points, Mat3::Identity());
  const double half = box.half_extents.maxCoeff();
  return nodesOf(points, box.center - Vec3::Constant(half), 2.0 * half, fnop);
}

struct SmallSplit {
  Points cloud = evenPoints(*testing::fan(1, 12), 150, 7);
  ClusteredOctree body = ClusteredOctree::build(testing::fan(1, 12));
  ClusteredOctree belt = ClusteredOctree::build(testing::torus(0.5, 0.05, 20, 8));
  Obb belt_box = principalBox(belt.mesh().vertices());
  std::vector<BeltPose> poses = posesAbout(body, belt, 100, 0.3, 3);
  SplitResult result =
      runSplitExperiment(cloud, belt_box, poses, {.k_means = {.seed = 5}, .repeats = 1}, kSilent);
};

TEST(SplitExperiment, nodes_vs_bruteforce) {
  const SmallSplit small;
  for (std::size_t method = 0; method < kMethods; ++method) {
    const std::size_t k = clustersOfMethod(method);
    for (std::size_t column = 0; column < kFnops; ++column) {
      std::size_t expected = 0;
      for (const Points& cluster : clustersOf(small.cloud, {.k = k, .seed = 5}))
        expected += nodesOf(cluster, fnopOf(column));
      const SplitCell& cell = small.result.cubes[method][column];
      ASSERT_EQ(cell.nodes, expected) << nameOfMethod(method) << ", FNOP " << fnopOf(column);
      EXPECT_TRUE(canBeNodeCount(static_cast<int>(cell.nodes), k));
      EXPECT_GT(cell.split_ms, 0.0);
    }
  }
}

TEST(SplitExperiment, alarms_vs_everyLeafCell) {
  const SmallSplit small;
  EXPECT_GT(small.result.touching, 30u);
  EXPECT_GT(small.result.clear, 30u);
  ASSERT_EQ(small.result.touching + small.result.clear, small.poses.size());
  std::size_t positives = 0;
  for (const bool principal : {false, true}) {
    const CellFrame frame = principal ? CellFrame::principal_box : CellFrame::cube;
    for (const std::size_t method : {0u, 3u}) {
      const Segmentation segmentation(clustersOf(small.cloud, {.k = clustersOfMethod(method), .seed = 5}), 3,
                                      frame);
      const std::vector<Obb> cells = segmentation.leafCells();
      std::size_t false_positives = 0, false_negatives = 0;
      for (const BeltPose& pose : small.poses) {
        bool called = false;
        for (const Obb& cell : cells) called |= overlaps(cell, pose.belt_in_mesh * small.belt_box);
        false_positives += called && !pose.touches;
        false_negatives += !called && pose.touches;
      }
      const SplitCell& cell = (principal ? small.result.principal : small.result.cubes)[method][2];
      EXPECT_EQ(cell.false_positives, false_positives);
      EXPECT_EQ(cell.false_negatives, false_negatives);
      positives += false_positives;
    }
  }
  EXPECT_GT(positives, 0u) << "nothing to tell apart";
}

TEST(SplitExperiment, kOptHasTheLeastLeafVolume) {
  const SmallSplit small;
  const auto nodes = numbersOf(small.result.cubes, &SplitCell::nodes);
  const auto volumes = numbersOf(small.result.principal, &SplitCell::leaf_volume);
  for (const std::size_t column : {1u, 4u, 9u}) {
    for (std::size_t k = 2; k <= 8; ++k) {
      const Segmentation segmentation(clustersOf(small.cloud, {.k = k, .seed = 5}), fnopOf(column),
                                      CellFrame::principal_box);
      const double volume = segmentation.leafVolume();
      EXPECT_NEAR(volumes[methodOfClusters(k)][column], volume, 1e-9 * volume);
      EXPECT_LE(volumes[methodOfClusters(bestK(volumes, column))][column],
                volumes[methodOfClusters(k)][column]);
      EXPECT_LE(nodes[methodOfClusters(bestK(nodes, column))][column], nodes[methodOfClusters(k)][column]);
    }
  }
}

TEST(SplitExperiment, sameSeedSameNumbers) {
  const SmallSplit one, other;
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      for (const auto& cells : {&SplitResult::cubes, &SplitResult::principal}) {
        const SplitCell &a = (one.result.*cells)[method][column], &b = (other.result.*cells)[method][column];
        EXPECT_EQ(a.nodes, b.nodes);
        EXPECT_EQ(a.leaf_volume, b.leaf_volume);
        EXPECT_EQ(a.false_positives, b.false_positives);
      }
    }
  }
}

TEST(SplitExperiment, seedsTableIsTheSpreadOfTheirRatios) {
  const SmallSplit small;
  SplitRun run{.blade_name = "fan", .points = small.cloud.size(), .result = small.result};
  double sum = 0.0, least = 10.0;
  for (const std::uint64_t seed : {5, 6, 7}) {
    run.of_seeds.push_back(runSplitExperiment(small.cloud, small.belt_box, {},
                                              {.k_means = {.seed = seed}, .repeats = 1}, kSilent));
    double mean = 0.0;
    for (std::size_t column = 0; column < kFnops; ++column) {
      const auto& cells = run.of_seeds.back().cubes;
      mean +=
          static_cast<double>(cells[3][column].nodes) / static_cast<double>(cells[0][column].nodes) / kFnops;
    }
    sum += mean;
    least = std::min(least, mean);
  }
  const Table table = seedsTable("name", "Nodes", run, &SplitCell::nodes);
  ASSERT_EQ(table.rows.size(), kMethods - 1 + 2);
  EXPECT_EQ(table.rows[2][0], nameOfMethod(3));
  EXPECT_EQ(table.rows[2][1], changeText(1.0, sum / 3.0));
  EXPECT_EQ(table.rows[2][2], changeText(1.0, least));
}

TEST(Published, threeEntriesOfTable1CannotBeNodeCounts) {
  std::set<std::array<int, 3>> impossible;  // k, FNOP, nodes
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      const int nodes = kPublishedNodes[method][column], k = static_cast<int>(clustersOfMethod(method));
      if (!canBeNodeCount(nodes, clustersOfMethod(method))) {
        impossible.insert({k, static_cast<int>(fnopOf(column)), nodes});
      }
    }
  }
  EXPECT_EQ(impossible, (std::set<std::array<int, 3>>{{2, 1, 11718}, {7, 10, 829}, {8, 4, 2286}}));
  EXPECT_TRUE(canBeNodeCount(1, 0));
  EXPECT_TRUE(canBeNodeCount(10, 2));
  EXPECT_FALSE(canBeNodeCount(2, 3)) << "fewer than roots";
}

TEST(Published, whatItsTablesSayThemselves) {
  EXPECT_EQ(cellsBelowTraditional(kPublishedNodes), 48);
  EXPECT_EQ(cellsBelowTraditional(kPublishedSeconds), 18);
  const TableCell nodes = bestAgainstTraditional(kPublishedNodes),
                  seconds = bestAgainstTraditional(kPublishedSeconds);
  EXPECT_EQ(clustersOfMethod(nodes.method), 2u);
  EXPECT_EQ(fnopOf(nodes.column), 2u);
  EXPECT_EQ(clustersOfMethod(seconds.method), 3u) << "not k = 2, as the paper says";
  EXPECT_EQ(fnopOf(seconds.column), 2u);
}

}  // namespace
}  // namespace octoblisk::demos
