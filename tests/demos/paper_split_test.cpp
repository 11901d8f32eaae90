// Tables 1 and 2 of the paper: their definitions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "build/paper/principal_box.h"
#include "demos/paper_report.h"
#include "geometry/bounding_box.h"
#include "geometry/separating_axis.h"
#include "io/number_text.h"
#include "paper/belt_poses.h"
#include "paper/segmentation.h"
#include "paper/split_experiment.h"
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
      ASSERT_EQ(cell.nodes, expected) << "k = " << k << ", FNOP " << fnopOf(column);
      EXPECT_EQ((cell.nodes - std::max<std::size_t>(k, 1)) % 8, 0u);
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

/// The report of Table 1 on an experiment.
PaperReport reportOfTable1(const SmallSplit& small, const nlohmann::json& of_seeds) {
  return reportOf("table1", "splits",
                  {{"points", small.cloud.size()}, {"result", small.result}, {"of_seeds", of_seeds}});
}

TEST(SplitExperiment, kOptHasTheLeastLeafVolume) {
  const SmallSplit small;
  const PaperReport report = reportOfTable1(small, nlohmann::json::array({small.result.cubes}));
  const Table& k_opt = tableOf(report, "table1_k_opt");
  for (const std::size_t column : {1u, 4u, 9u}) {
    const auto bestOf = [&](std::size_t row) { return std::stoul(k_opt.rows[row][1 + column]) - 1; };
    for (std::size_t method = 1; method < kMethods; ++method) {
      const Segmentation segmentation(clustersOf(small.cloud, {.k = clustersOfMethod(method), .seed = 5}),
                                      fnopOf(column), CellFrame::principal_box);
      const double volume = segmentation.leafVolume();
      EXPECT_NEAR(small.result.principal[method][column].leaf_volume, volume, 1e-9 * volume);
      EXPECT_LE(small.result.cubes[bestOf(0)][column].nodes, small.result.cubes[method][column].nodes);
      EXPECT_LE(small.result.principal[bestOf(1)][column].leaf_volume,
                small.result.principal[method][column].leaf_volume);
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
  nlohmann::json of_seeds;
  double sum = 0.0, least = 10.0;
  for (const std::uint64_t seed : {5, 6, 7}) {
    const auto cells = runSplitExperiment(small.cloud, small.belt_box, {},
                                          {.k_means = {.seed = seed}, .repeats = 1}, kSilent)
                           .cubes;
    of_seeds.push_back(cells);
    double mean = 0.0;
    for (std::size_t column = 0; column < kFnops; ++column) {
      mean +=
          static_cast<double>(cells[3][column].nodes) / static_cast<double>(cells[0][column].nodes) / kFnops;
    }
    sum += mean;
    least = std::min(least, mean);
  }
  const PaperReport report = reportOfTable1(small, of_seeds);
  const Table& table = tableOf(report, "table1_seeds");
  ASSERT_EQ(table.rows.size(), kMethods - 1 + 2);
  EXPECT_EQ(table.rows[2][0], "k = 4");
  EXPECT_EQ(table.rows[2][1], changeText(1.0, sum / 3.0));
  EXPECT_EQ(table.rows[2][2], changeText(1.0, least));
}

}  // namespace
}  // namespace octoblisk::demos
