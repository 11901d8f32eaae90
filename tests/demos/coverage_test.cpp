// The coverage of a blade's side, compared with brute force at many more places of the same path.
#include "grinding/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "demos/default_blisk.h"
#include "models/blade_anatomy.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/motion.h"
#include "toolpath/grinding_path.h"
#include "toolpath/surface_path.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

struct Side {
  TriangleMesh mesh = embeddedBlisk();
  BladesFound blades = findBlades(mesh);
  BliskAnatomy anatomy = findAnatomy(mesh, blades);
  BladeContours contours{mesh, anatomy.sides, 1};
};
const Side& side() {
  static const Side result;
  return result;
}

TEST(SideGrid, liesOnTheSideAndHasItsArea) {
  const SideGrid grid(side().contours, BladeRegion::forward, 40, 50);
  ASSERT_EQ(grid.size(), 2000u);
  const auto tree = treeOf(side().mesh);
  const TriangleMesh cells = grid.mesh();
  double area = 0.0;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    const ContourPoint& middle = grid.middleOf(cell);
    const ClosestPoint nearest = closestPoint(*tree, middle.position).value();
    EXPECT_LT(nearest.distance, 1e-6);
    EXPECT_EQ(side().blades.blade_of_triangle[nearest.triangle], 1);
    EXPECT_GT(scaledNormal(cells.triangle(2 * cell)).dot(middle.normal), 0.0);
    area += grid.areaOf(cell);
    if (cell % 50 != 0) {
      EXPECT_GT(grid.chordOf(cell), grid.chordOf(cell - 1));
    }
  }
  EXPECT_NEAR(area, side().anatomy.blades[0].forward_area, 0.02 * area);
  EXPECT_DOUBLE_EQ(grid.heightOf(0), 0.5 / 40);
  EXPECT_DOUBLE_EQ(grid.heightOf(1999), 1.0 - 0.5 / 40);
}

TEST(SupportPlanes, noVertexIsAboveOne_vs_bruteforce) {
  const auto belt = treeOf(embeddedBeltGrinder().front().mesh);
  const SupportPlanes planes(*belt);
  const Aabb& bounds = belt->mesh().bounds();
  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int tight = 0;
  constexpr int kPoints = 500;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 direction(uniform(random), uniform(random), uniform(random));
    const std::size_t plane = planes.facing(direction);
    const double at_origin = planes.heightAbove(plane, Vec3::Zero());
    Vec3 normal;  // the gradient of the height
    for (int k = 0; k < 3; ++k) normal[k] = planes.heightAbove(plane, Vec3::Unit(k)) - at_origin;
    EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
    EXPECT_LT(std::acos(std::min(1.0, normal.dot(direction.normalized()))), 0.045);
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vec3& vertex : belt->mesh().vertices())
      highest = std::max(highest, planes.heightAbove(plane, vertex));
    EXPECT_NEAR(highest, 0.0, 1e-9);

    const Vec3 point = bounds.center() + 1.5 * direction.cwiseProduct(bounds.halfExtents());
    const ClosestPoint nearest = closestPoint(*belt, point).value();
    const double height = planes.heightAbove(planes.facing(point - nearest.point), point);
    EXPECT_LE(height, nearest.distance + 1e-9);
    tight += height > 0.9 * nearest.distance;
  }
  EXPECT_GT(tight, kPoints / 4);
}

TEST(Coverage, points_vs_bruteforce) {
  const SideGrid grid(side().contours, BladeRegion::forward, 40, 12);
  const auto belt = treeOf(embeddedBeltGrinder().front().mesh);
  const octoblisk::Surface surface(*belt);
  const std::vector<Pose> path = makeGrindingPath(side().mesh, side().blades,
                                                  {.passes = 3,
                                                   .poses_per_pass = 12,
                                                   .depth = 0.05,
                                                   .span_from = 0.9,
                                                   .span_to = 0.8,
                                                   .retract_poses = 1});
  const std::vector<GroundPoint> found = groundPoints(grid, *belt, path, 1);
  const std::vector<GroundPoint> by_three = groundPoints(grid, *belt, path, 3);
  int ground = 0, near = 0;
  for (std::size_t cell = 0; cell < grid.size(); ++cell) {
    ASSERT_EQ(found[cell].depth, by_three[cell].depth);
    ASSERT_EQ(found[cell].pose, by_three[cell].pose);
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 1; p < path.size(); ++p) {
      const Motion motion(path[p - 1], path[p]);
      constexpr int kPlaces = 40;
      for (int k = 0; k <= kPlaces; ++k) {
        const Vec3 point =
            motion.at(static_cast<double>(k) / kPlaces).inverse() * grid.middleOf(cell).position;
        const double distance = closestPoint(*belt, point).value().distance;
        deepest = std::max(deepest, locate(surface, point) == PointLocation::inside ? distance : -distance);
      }
    }
    ground += deepest >= 0.0;
    near += deepest < 0.0 && deepest >= -kCoverageReach;
    if (deepest < -kCoverageReach) {
      EXPECT_FALSE(found[cell].isNear()) << cell;
      continue;
    }
    if (!found[cell].isNear()) {
      EXPECT_LT(deepest, -kCoverageReach + 0.01) << cell;
      continue;
    }
    // The deepest of all places: no place in between is missed by more than a step permits.
    EXPECT_NEAR(found[cell].depth, deepest, 0.01) << cell;
    const double at_pose =
        closestPoint(*belt, path[found[cell].pose].inverse() * grid.middleOf(cell).position).value().distance;
    EXPECT_LT(at_pose, std::abs(found[cell].depth) + 5.0) << "a pose near there";
  }
  EXPECT_GT(ground, 10);
  EXPECT_GT(near, 10);
}

Coverage coverageByHand(const std::function<double(double height, double chord)>& depth,
                        BladeRegion region = BladeRegion::forward, const char* name = "convex") {
  Coverage coverage{.blade = 1,
                    .grid = SideGrid(side().contours, region, 10, 10),
                    .side = name,
                    .mesh_in_blisk = {},
                    .max_depth = 0.1,
                    .points = std::vector<GroundPoint>(100)};
  for (std::size_t cell = 0; cell < 100; ++cell) {
    coverage.points[cell].depth = depth(coverage.grid.heightOf(cell), coverage.grid.chordOf(cell));
  }
  return coverage;
}

TEST(Coverage, wordsByHand) {
  const Coverage all = coverageByHand([](double, double) { return 0.01; });
  EXPECT_DOUBLE_EQ(all.share(CellState::ground), 1.0);
  EXPECT_EQ(
      groundText(all),
      "Ground: 100 % of the convex side of blade 1; too deep: 0 %, left standing: 0 %, not reached: 0 %");
  EXPECT_EQ(leftText(all), "");
  constexpr double kFar = -std::numeric_limits<double>::infinity();
  const Coverage some = coverageByHand([](double height, double chord) {
    if (height < 0.3 || chord > 0.8) return kFar;
    return std::abs(height - 0.55) < 0.01 ? -0.02 : 0.01;  // a scallop
  });
  EXPECT_DOUBLE_EQ(some.scallopHeight(), 0.02);
  EXPECT_EQ(leftText(some),
            "Not reached: root below 0.3 of the height, trailing edge beyond 0.8 of the chord; left between "
            "passes: scallops up to 0.02 mm");
  const Coverage gap =
      coverageByHand([](double height, double) { return height > 0.4 && height < 0.6 ? kFar : 0.0; });
  EXPECT_EQ(leftText(gap), "Left between passes: more than 0.5 mm");
  const Coverage edge = coverageByHand([](double, double chord) { return chord < 0.2 ? kFar : 0.0; },
                                       BladeRegion::trailing_edge, "trailing");
  EXPECT_THAT(groundText(edge), HasSubstr(" % of the trailing edge of blade 1; "));
  EXPECT_EQ(leftText(edge), "Not reached: backward side before 0.2 of the width");
}

TEST(Coverage, theFourSharesAddUpToTheWholeArea) {
  std::mt19937_64 random(62);
  std::uniform_real_distribution<double> depth(-0.8, 0.4);
  for (int i = 0; i < 20; ++i) {
    const Coverage coverage = coverageByHand([&](double, double) { return depth(random); });
    std::array<double, 4> areas = {};
    double area = 0.0;
    for (std::size_t cell = 0; cell < coverage.grid.size(); ++cell) {
      const double here = coverage.points[cell].depth;
      areas[here < -0.5                 ? 3
            : here < 0.0                ? 2
            : here > coverage.max_depth ? 1
                                        : 0] += coverage.grid.areaOf(cell);
      area += coverage.grid.areaOf(cell);
    }
    const std::array<double, 4> percents = coverage.percents();
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_GT(areas[k], 0.0);
      EXPECT_NEAR(coverage.share(kCellStates[k]), areas[k] / area, 1e-12);
      EXPECT_NEAR(percents[k], 100.0 * areas[k] / area, 0.1);
      sum += percents[k];
    }
    EXPECT_NEAR(sum, 100.0, 1e-9);
  }
}

TEST(SideGrid, anEdgeHasItsReachOnBothSides) {
  for (const BladeRegion region : {BladeRegion::leading_edge, BladeRegion::trailing_edge}) {
    const SideGrid grid(side().contours, region, 20, 6);
    const auto tree = treeOf(side().mesh);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
      const BladeContour contour = side().contours.at(grid.heightOf(row * 6));
      const Vec3 edge = region == BladeRegion::leading_edge ? contour.forward.front().position
                                                            : contour.forward.back().position;
      for (std::size_t column = 0; column < 6; ++column) {
        const Vec3& middle = grid.middleOf(row * 6 + column).position;
        EXPECT_LT(closestPoint(*tree, middle)->distance, 1e-6);
        const double along = std::abs(static_cast<double>(column) - 2.5);  // mm from the edge
        EXPECT_LE((middle - edge).norm(), along + 1e-6);
        EXPECT_GE((middle - edge).norm(), 0.7 * along - 0.3);
      }
    }
    const Vec3 backward = grid.middleOf(0).position, forward = grid.middleOf(5).position;
    EXPECT_GT((forward - backward).dot(Vec3(-forward.y(), forward.x(), 0.0)), 0.0);
  }
}

GrindingJob jobOfBuiltIn() {
  GrindingJob job;
  job.blisk = treeOf(side().mesh);
  job.blades = side().blades;
  for (EmbeddedPart& part : embeddedBeltGrinder()) job.parts.push_back({part.name, treeOf(part.mesh)});
  job.rules.near_miss = 0.5;
  job.continuous = false;
  return job;
}

std::vector<Pose> posesOf(const SurfacePathOptions& options) {
  std::vector<Pose> poses;
  for (const ToolMotion& motion : makeSurfacePath(side().contours, options).motions)
    poses.push_back(motion.tool_in_blisk);
  return poses;
}

TEST(Coverage, isOfTheRegionThatThePathIsMadeFor) {
  GrindingJob job = jobOfBuiltIn();
  const std::pair<BladeRegion, const char*> regions[] = {{BladeRegion::forward, "forward"},
                                                         {BladeRegion::backward, "backward"},
                                                         {BladeRegion::leading_edge, "leading"},
                                                         {BladeRegion::trailing_edge, "trailing"}};
  for (const auto& [region, name] : regions) {
    // A belt that is pressed through the blade touches the other side as often.
    for (const double depth : {0.05, 3.0}) {
      job.path = posesOf({.region = region, .step_over = 20.0, .pose_step = 8.0, .depth = depth});
      const auto coverage = coverageOf(job, job.path, std::nullopt);
      ASSERT_TRUE(coverage);
      EXPECT_EQ(coverage->side, name) << depth;
      EXPECT_GT(coverage->share(CellState::ground) + coverage->share(CellState::too_deep), 0.01);
      if (depth == 3.0) {
        EXPECT_GT(coverage->share(CellState::too_deep), coverage->share(CellState::ground)) << name;
      }
    }
  }
  for (Pose& pose : job.path) pose.translation += Vec3(0, 0, 500);
  EXPECT_FALSE(coverageOf(job, job.path, std::nullopt));
}

/// A wheel that is nowhere deeper than asked for rests on the edges of coarse facets, so the lines are
/// interrupted there. On finer facets the same path grinds whole lines.
TEST(Coverage, linesAreWholeWhereFacetsAreFiner) {
  const auto groundAlongPass = [](const TriangleMesh& mesh) {
    const BladesFound blades = findBlades(mesh);
    const BladeSides sides = findAnatomy(mesh, blades).sides;
    const BladeContours contours(mesh, sides, 1);
    const SurfacePathOptions options{.step_over = 20.0, .height_from = 0.6, .height_to = 0.6, .retract = 2.0};
    std::vector<Pose> poses;
    const WheelSeat seat(mesh, sides.blade_of_triangle, 1, options.wheel_radius, BeltParameters{}.width);
    for (const ToolMotion& motion : makeSurfacePath(contours, options, &seat).motions)
      poses.push_back(motion.tool_in_blisk);
    constexpr std::size_t kRows = 200, kColumns = 50;
    const SideGrid grid(contours, BladeRegion::forward, kRows, kColumns);
    const auto points = groundPoints(grid, *treeOf(embeddedBeltGrinder().front().mesh), poses);
    int most = 0;  // of the cells of a row, without those beside the edges, which the path leaves out
    for (std::size_t row = 0; row < kRows; ++row) {
      int touched = 0;
      for (std::size_t column = 5; column < 45; ++column)
        touched += points[row * kColumns + column].isTouched();
      most = std::max(most, touched);
    }
    return most;
  };
  EXPECT_LT(groundAlongPass(side().mesh), 30);
  EXPECT_EQ(groundAlongPass(makeDefaultBlisk(400'000).mesh), 40);
}

}  // namespace
}  // namespace octoblisk::demos
