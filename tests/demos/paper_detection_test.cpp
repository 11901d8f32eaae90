// Table 3 of the paper: the boxes left at a pose, false alarms and misses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"
#include "paper/belt_poses.h"
#include "paper/blisk_ranges.h"
#include "paper/box_detection.h"
#include "paper/detection_experiment.h"
#include "paper/detection_replay.h"
#include "paper/detection_seeds.h"
#include "paper/surface_points.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

const Progress kNoProgress = [](double) {};

ClusteredOctree fanTree() { return ClusteredOctree::build(testing::fan(3, 10)); }
ClusteredOctree ringTree() { return ClusteredOctree::build(testing::torus(0.5, 0.08, 16, 8)); }

std::vector<Obb> leafBoxes(const ClusteredOctree& tree) { return tree.boxes(ClusteredOctree::kMaxDepth); }

TEST(BoxDetection, cellsLeft_vs_everyCell) {
  const Points cloud = evenPoints(*testing::fan(3, 10), 200, 1);
  const Obb box = principalBox(ringTree().mesh().vertices());
  std::mt19937_64 random(71);
  int hits = 0, more_by_one_axis = 0;
  constexpr int kPoses = 200;
  for (const CellFrame frame : {CellFrame::cube, CellFrame::principal_box}) {
    const Segmentation segmentation(clustersOf(cloud, {.k = 3}), 4, frame);
    const std::vector<Obb> cells = segmentation.leafCells();
    for (int i = 0; i < kPoses; ++i) {
      const Obb there = testing::randomPose(random, 1.5) * box;
      BoxesLeft expected;
      for (const Obb& cell : cells) {
        if (!overlaps(there, cell)) continue;
        ++expected.leaves;
        expected.volume += cell.volume();
      }
      const BoxesLeft found = leavesNear(segmentation, there, SeparatingAxes::exact15);
      ASSERT_EQ(found.leaves, expected.leaves) << "pose " << i;
      ASSERT_NEAR(found.volume, expected.volume, 1e-9);
      ASSERT_EQ(anyLeafNear(segmentation, there), expected.isColliding());
      hits += expected.isColliding();
      const BoxesLeft one_axis = leavesNear(segmentation, there, SeparatingAxes::first_x);
      ASSERT_GE(one_axis.leaves, expected.leaves) << "one axis never misses an overlap";
      more_by_one_axis += one_axis.leaves > expected.leaves;
    }
  }
  EXPECT_GT(hits, 2 * kPoses * 3 / 10);
  EXPECT_LT(hits, 2 * kPoses * 7 / 10);
  EXPECT_GT(more_by_one_axis, kPoses / 5);
}

TEST(BoxDetection, leafBoxesLeft_vs_everyPair) {
  const ClusteredOctree blisk = fanTree(), belt = ClusteredOctree::build(testing::torus(0.5, 0.25, 16, 8));
  const Obb belt_box = principalBox(belt.mesh().vertices());
  const std::vector<Obb> leaves = leafBoxes(blisk), belt_leaves = leafBoxes(belt);
  std::mt19937_64 random(72);
  int hits = 0;
  std::size_t found = 0, expected = 0;
  constexpr int kPoses = 100;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.0);
    BoxesLeft against_box, against_boxes;
    for (const Obb& leaf : leaves) {
      if (overlaps(leaf, pose * belt_box)) {
        ++against_box.leaves;
        against_box.volume += leaf.volume();
      }
      const auto meets = [&](const Obb& other) { return overlaps(leaf, pose * other); };
      if (std::ranges::any_of(belt_leaves, meets)) {
        ++against_boxes.leaves;
        against_boxes.volume += leaf.volume();
      }
    }
    const BoxesLeft near_box = leavesNear(blisk, pose * belt_box), near_boxes = leavesNear(blisk, belt, pose);
    // The search starts at the root, so a leaf box that overlaps only outside a box above it is left out.
    ASSERT_LE(near_box.leaves, against_box.leaves) << "pose " << i;
    ASSERT_LE(near_boxes.leaves, against_boxes.leaves) << "pose " << i;
    ASSERT_LE(near_boxes.volume, against_boxes.volume + 1e-12);
    found += near_box.leaves + near_boxes.leaves;
    expected += against_box.leaves + against_boxes.leaves;
    // Every touch is in a found leaf.
    const bool touches = !testing::bruteForcePairs(blisk.mesh(), belt.mesh(), pose).empty();
    ASSERT_TRUE(near_boxes.isColliding() || !touches) << "pose " << i;
    ASSERT_TRUE(near_box.isColliding() || !touches) << "pose " << i;
    hits += near_boxes.isColliding();
  }
  EXPECT_GT(found, expected * 9 / 10);
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
}

TEST(BoxDetection, cellsThatTrianglesMeet_vs_everyTriangle) {
  const Points cloud = evenPoints(*testing::fan(3, 10), 150, 1);
  const Segmentation segmentation(clustersOf(cloud, {.k = 2}), 1, CellFrame::box);
  const std::vector<Obb> cells = segmentation.leafCells();
  const ClusteredOctree blisk = fanTree(), belt = ringTree();
  const std::vector<Obb> leaves = leafBoxes(blisk);
  const auto meetsAny = [&](const std::vector<Obb>& boxes, const Pose& pose) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < belt.mesh().triangleCount(); ++t) {
      triangles.push_back(pose * belt.mesh().triangle(t));
    }
    for (const Obb& box : boxes) {
      for (const Triangle& triangle : triangles) {
        if (testing::boxTriangleOverlap(box, triangle) >= 0.0) return true;
      }
    }
    return false;
  };
  std::mt19937_64 random(73);
  int hits = 0;
  constexpr int kPoses = 40;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.2);
    const bool expected = meetsAny(cells, pose);
    ASSERT_EQ(anyLeafMeets(segmentation, belt, pose), expected) << "pose " << i;
    ASSERT_EQ(anyLeafMeets(blisk, belt, pose), meetsAny(leaves, pose)) << "pose " << i;
    hits += expected;
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
}

/// The corners of a box.
Points cornersOf(const Vec3& low, const Vec3& size) {
  Points points;
  for (int corner = 0; corner < 8; ++corner) {
    points.push_back(low + Vec3(corner & 1, corner >> 1 & 1, corner >> 2).cwiseProduct(size));
  }
  return points;
}

TEST(BliskRanges, ofTwoBoxesByHand) {
  // Two boxes of 1 × 2 × 3, 9 apart along x.
  const std::vector<Points> parts = {cornersOf({0, 0, 0}, {1, 2, 3}), cornersOf({10, 0, 0}, {1, 2, 3})};
  const BliskRanges ranges = findBliskRanges(parts, {});
  EXPECT_DOUBLE_EQ(ranges.whole.axis_aligned, 11.0 * 2.0 * 3.0);
  EXPECT_NEAR(ranges.whole.principal, 11.0 * 2.0 * 3.0, 1e-9);
  ASSERT_EQ(ranges.at_once.size(), 7u);
  EXPECT_EQ(ranges.at_once[0].k, 2u);
  EXPECT_DOUBLE_EQ(ranges.at_once[0].axis_aligned, 12.0) << "two clusters are the two boxes";
  ASSERT_EQ(ranges.by_parts.size(), 8u);
  EXPECT_EQ(ranges.by_parts[0].boxes, 2u);
  EXPECT_DOUBLE_EQ(ranges.by_parts[0].axis_aligned, 12.0);
  // Eight clusters of eight points are single points.
  EXPECT_EQ(ranges.by_parts[7].boxes, 16u);
  EXPECT_DOUBLE_EQ(ranges.by_parts[7].axis_aligned, 0.0);
}

TEST(Alarms, countsWhatIsFalseAndWhatIsMissed) {
  Alarms alarms;
  alarms.count({{}, true}, true);
  alarms.count({{}, true}, false);
  alarms.count({{}, false}, true);
  alarms.count({{}, false}, true);
  alarms.count({{}, false}, false);
  EXPECT_EQ(alarms.touching, 2u);
  EXPECT_EQ(alarms.clear, 3u);
  EXPECT_EQ(alarms.false_negatives, 1u);
  EXPECT_EQ(alarms.false_positives, 2u);
}

struct SmallDetection {
  ClusteredOctree blisk = fanTree(), belt = ringTree();
  std::vector<Points> parts = {evenPoints(blisk.mesh(), 120, 1)};
  std::vector<BeltPose> poses = posesAbout(blisk, belt, 60, 0.6, 2);
  DetectionResult result = runDetectionExperiment(blisk, belt, parts, poses, poses, {.fnop = 2}, kNoProgress);
};

TEST(DetectionExperiment, rowsAgreeWithTheirDefinitions) {
  const SmallDetection small;
  ASSERT_EQ(small.result.rows.size(), std::size_t{kDetectionMethods});
  std::size_t touching = 0;
  for (const BeltPose& pose : small.poses) {
    const bool expected =
        !testing::bruteForcePairs(small.blisk.mesh(), small.belt.mesh(), pose.belt_in_mesh).empty();
    ASSERT_EQ(pose.touches, expected);
    touching += expected;
  }
  EXPECT_GT(touching, small.poses.size() * 3 / 10);
  EXPECT_LT(touching, small.poses.size() * 7 / 10);
  for (const DetectionRow& row : small.result.rows) {
    EXPECT_EQ(row.ground.touching, touching) << row.method;
    EXPECT_EQ(row.ground.clear, small.poses.size() - touching);
    EXPECT_EQ(row.ground.false_positives, row.lifted.false_positives) << "the same poses";
    for (const double seconds : row.run_seconds) EXPECT_GT(seconds, 0.0) << row.method;
    if (!row.is_exact) continue;
    EXPECT_EQ(row.ground.false_positives + row.ground.false_negatives, 0u) << row.method;
  }
  const auto& rows = small.result.rows;
  for (const DetectionMethod whole_triangles : {kOneAabb, kOneObb, kOursBoxes, kOursBothBoxes}) {
    EXPECT_EQ(rows[whole_triangles].ground.false_negatives, 0u) << rows[whole_triangles].method;
  }
  EXPECT_EQ(rows[kTraditional].range, boundingBox(small.parts[0], Mat3::Identity()).volume());
  EXPECT_EQ(rows[kOneAabb].range, boundingBox(small.blisk.mesh().vertices(), Mat3::Identity()).volume());
  EXPECT_LE(rows[kOursBothBoxes].ground.false_positives, rows[kOursBoxes].ground.false_positives);
  EXPECT_LE(rows[kTraditional].ground.false_positives, rows[kTraditionalOneAxis].ground.false_positives);
}

TEST(DetectionSeeds, rangesAreThoseOfEachSeedsBoxes) {
  const SmallDetection small;
  const auto cloudsOf = [&](std::uint64_t seed) {
    return std::vector<Points>{evenPoints(small.blisk.mesh(), 120, seed)};
  };
  std::vector<Pose> poses;
  for (const BeltPose& pose : small.poses) poses.push_back(pose.belt_in_mesh);
  const Obb belt_box = principalBox(small.belt.mesh().vertices());
  const DetectionSeeds seeds = detectionOverSeeds(
      cloudsOf, belt_box, poses, {.count = 4, .k_means = {.seed = 7}, .runs = 2}, kNoProgress);
  ASSERT_EQ(seeds.count(), 4u);
  for (std::size_t i = 0; i < seeds.count(); ++i) {
    const Points cloud = cloudsOf(7 + i).front();
    double range = 0.0, principal = 0.0;
    for (const Points& cluster : clustersOf(cloud, {.k = 2, .seed = 7 + i})) {
      range += boundingBox(cluster, Mat3::Identity()).volume();
      principal += principalBox(cluster).volume();
    }
    const double whole = boundingBox(cloud, Mat3::Identity()).volume();
    EXPECT_NEAR(seeds.range[i], range / whole, 1e-12);
    EXPECT_NEAR(seeds.principal_range[i], principal / whole, 1e-12);
    EXPECT_GT(seeds.seconds[i], 0.0);
  }
  EXPECT_NE(seeds.range[0], seeds.range[1]);
}

TEST(DetectionReplay, posesSayWhatTheTrianglesAndTheBoxesSay) {
  const SmallDetection small;
  const auto mesh = std::make_shared<const TriangleMesh>(small.blisk.mesh());
  PaperModel model{.name = "fan", .mesh = mesh, .blades = {}, .blade = mesh};
  model.blades.blade_of_triangle.assign(mesh->triangleCount(), 0);
  const DetectionScene scene{.model = model,
                             .blisk = std::make_shared<const ClusteredOctree>(small.blisk),
                             .belt = std::make_shared<const ClusteredOctree>(small.belt),
                             .ground = small.poses,
                             .lifted = small.poses,
                             .lift = 1.0};
  const Replay replay = detectionReplay(scene, small.result);
  ASSERT_EQ(replay.tracks.size(), 2u);
  const Alarms& alarms = small.result.rows[kImproved].lifted;
  EXPECT_GT(alarms.false_positives, 0u) << "otherwise the findings are not tested";
  for (const ReplayTrack& track : replay.tracks) {
    ASSERT_EQ(track.poses.size(), small.poses.size());
    for (std::size_t p = 0; p < small.poses.size(); ++p) {
      EXPECT_EQ(track.poses[p].contacts.empty(), !small.poses[p].touches) << p;
      EXPECT_EQ(track.series.front().values[p] == 0.0, small.poses[p].touches) << p;
    }
    const auto wrong = [&](const ReplayPose& pose) {
      return replay.verdicts[pose.verdict].tone == Tone::interference;
    };
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count_if(track.poses, wrong)),
              alarms.false_positives + alarms.false_negatives);
    EXPECT_EQ(track.findings.size(), alarms.false_positives + alarms.false_negatives);
    for (const ReplayFinding& finding : track.findings) {
      EXPECT_EQ(*finding.value == 0.0, small.poses[static_cast<std::size_t>(finding.at)].touches);
    }
  }
  std::size_t counted = 0;
  for (const ReplayCount& count : replay.counts) counted += count.count;
  EXPECT_EQ(counted, small.poses.size());
}

/// Whether a triangle of the body meets the box of any leaf's points, by brute force.
bool meetsAnyFittedBox(const Points& cloud, const Segmentation& segmentation, const TriangleMesh& body,
                       const Pose& pose) {
  const Octree& octree = segmentation.octrees().front();
  for (const Octree::Node& node : octree.nodes()) {
    if (!node.isLeaf() || node.count() == 0) continue;
    Points points;
    for (std::uint32_t i = node.begin; i < node.end; ++i) points.push_back(cloud[octree.order()[i]]);
    const Obb box = boundingBox(points, Mat3::Identity());
    for (std::size_t t = 0; t < body.triangleCount(); ++t) {
      if (testing::boxTriangleOverlap(box, pose * body.triangle(t)) >= 0.0) return true;
    }
  }
  return false;
}

TEST(DetectionExperiment, holesAreContactsThatNoBoxCovers) {
  const SmallDetection small;
  const std::vector<HolesRow>& holes = small.result.holes;
  ASSERT_EQ(holes.size(), std::size_t{kHoleKinds});
  const Points& cloud = small.parts[0];
  const Segmentation traditional(std::span(&cloud, 1), 2, CellFrame::box);
  std::size_t missed_by_cells = 0, missed_by_fitted = 0, touching = 0;
  for (const BeltPose& pose : small.poses) {
    if (!pose.touches) continue;
    ++touching;
    missed_by_cells += !anyLeafMeets(traditional, small.belt, pose.belt_in_mesh);
    missed_by_fitted += !meetsAnyFittedBox(cloud, traditional, small.belt.mesh(), pose.belt_in_mesh);
  }
  EXPECT_EQ(holes[kCellsTraditional].touching, 2 * touching) << "both paths";
  EXPECT_EQ(holes[kCellsTraditional].missed, 2 * missed_by_cells);
  EXPECT_EQ(holes[kFittedTraditional].missed, 2 * missed_by_fitted);
  EXPECT_GT(missed_by_fitted, 0u) << "erratum 14";
  EXPECT_EQ(holes[kWholeTriangles].missed, 0u);
}

TEST(SurfacePoints, lieEvenlyOnTheSurfaceAndAreTheSameForTheSameSeed) {
  const TriangleMesh box = *testing::boxMesh({1.0, 1.0, 1.0});
  const std::vector<Vec3> points = evenPoints(box, 200, 3);
  ASSERT_EQ(points.size(), 200u);
  double nearest = 10.0;
  std::array<int, 6> on_face{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    int axis = 0;
    EXPECT_NEAR(points[i].cwiseAbs().maxCoeff(&axis), 1.0, 1e-12);
    ++on_face[static_cast<std::size_t>(2 * axis) + (points[i][axis] > 0.0)];
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, (points[i] - points[j]).norm());
  }
  // Evenly spread, 200 points on an area of 24 are at most 0.37 apart; random ones come within 0.02.
  EXPECT_GT(nearest, 0.2);
  for (const int count : on_face) EXPECT_NEAR(count, 200 / 6, 9);
  EXPECT_TRUE(points == evenPoints(box, 200, 3));
  EXPECT_FALSE(points == evenPoints(box, 200, 4));
  EXPECT_DOUBLE_EQ(surfaceArea(box), 24.0);
}

TEST(SurfacePoints, refuseNoPointsNoAreaAndNoPart) {
  const TriangleMesh box = *testing::boxMesh({1.0, 1.0, 1.0});
  EXPECT_THROW(evenPoints(box, 0, 1), std::invalid_argument);
  const TriangleMesh flat({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {{0, 1, 2}});
  EXPECT_THROW(evenPoints(flat, 5, 1), std::invalid_argument);
  const std::vector<int> numbers = {1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2};
  const TriangleMesh part = partOf(box, numbers, 1);
  EXPECT_EQ(part.triangleCount(), 2u);
  EXPECT_TRUE(part.triangle(1) == box.triangle(1));
  EXPECT_LE(part.vertices().size(), 6u);
  EXPECT_THROW(partOf(box, numbers, 3), std::invalid_argument);
  EXPECT_THROW(partOf(box, std::span(numbers).first(3), 1), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::demos
