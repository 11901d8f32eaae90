// A plan of a blade's side, compared with a dense sampling of its path and with closed forms.
#include "plan/side_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "demos/small_blisk.h"
#include "grinding/grinding_run.h"
#include "models/belt_path.h"
#include "models/blade_anatomy.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "octoblisk/motion.h"
#include "plan/links.h"
#include "plan/pass_lines.h"

namespace octoblisk::demos {
namespace {

constexpr double kDepthLimit = 0.1;  // mm

struct Task {
  std::shared_ptr<const ClusteredOctree> blisk = treeOf(smallBlisk());
  BladesFound blades = findBlades(blisk->mesh());
  BladeSides sides = findBladeSides(blisk->mesh(), blades);
  std::vector<ToolPart> parts = {{"belt", treeOf(makeBelt(smallBelt()))}};
  VerdictRules rules{.max_depth = kDepthLimit, .near_miss = 0.0};
  SideGrid grid{BladeContours(blisk->mesh(), sides, 1), BladeRegion::forward, 40, 24};
  WheelSize wheel = wheelOf(*parts[0].tree);
  WheelSeat seat{blisk->mesh(), sides.blade_of_triangle, 1, wheel.radius, wheel.width};

  SidePlan plan(int threads) const {
    Judge judge(blisk, parts, blades.blade_of_triangle, rules, threads);
    return planSide(judge, grid, {}, seat, {.threads = threads});
  }
};
const Task& task() {
  static const Task result;
  return result;
}
const SidePlan& planned() {
  static const SidePlan result = task().plan(2);
  return result;
}

double groundShare(const SidePlan& plan) {
  double ground = 0.0, all = 0.0;
  for (std::size_t cell = 0; cell < plan.points.size(); ++cell) {
    all += task().grid.areaOf(cell);
    if (plan.points[cell].isTouched()) ground += task().grid.areaOf(cell);
  }
  return ground / all;
}

TEST(SidePlan, grindsNearlyAllOfTheSideWithoutInterference) {
  GrindingJob job;
  job.blisk = task().blisk;
  job.blades = task().blades;
  job.parts = task().parts;
  job.rules = task().rules;
  job.path = planned().path;
  const GrindingRun run = runGrinding(job);
  EXPECT_FALSE(run.interferes());
  EXPECT_GT(run.count(Verdict::intended_contact), 50u);
  EXPECT_EQ(run.motionCount() + 1, planned().path.size());
  EXPECT_GT(groundShare(planned()), 0.9);

  double of_setups = 0.0, unreached = 0.0;
  for (const PlannedSetup& setup : planned().setups) of_setups += setup.ground;
  for (const UnreachedArea& area : planned().unreached) unreached += area.share;
  EXPECT_NEAR(of_setups, groundShare(planned()), 1e-9);
  EXPECT_NEAR(of_setups + unreached, 1.0, 0.01);
}

TEST(SidePlan, grindsTheCellsThatADenseSamplingFindsInTheWheel) {
  // The belt on the contact wheel is a cylinder, up to its facets. A cell may leave it between two samples.
  const double facets = task().wheel.radius * (1.0 - std::cos(0.5 * BeltPath(smallBelt()).greatestTurn()));
  const double slack = facets + 2e-3;
  std::vector<double> deepest(task().grid.size(), -1e9);
  const SidePlan& plan = planned();
  for (std::size_t p = 1; p < plan.path.size(); ++p) {
    const Motion motion(plan.path[p - 1], plan.path[p]);
    constexpr int kSteps = 16;
    for (int k = plan.grinds[p] && plan.grinds[p - 1] ? 1 : kSteps; k <= kSteps; ++k) {
      const Pose blisk_in_tool = motion.at(static_cast<double>(k) / kSteps).inverse();
      for (std::size_t cell = 0; cell < deepest.size(); ++cell) {
        const Vec3 point = blisk_in_tool * task().grid.middleOf(cell).position;
        const double depth = std::min(task().wheel.radius - point.head<2>().norm(),
                                      0.5 * task().wheel.width - std::abs(point.z()));
        deepest[cell] = std::max(deepest[cell], depth);
      }
    }
  }
  std::size_t ground = 0, left = 0;
  for (std::size_t cell = 0; cell < deepest.size(); ++cell) {
    const bool is_ground = plan.points[cell].isTouched();
    if (is_ground) {
      EXPECT_GT(deepest[cell], -slack) << cell;
    } else {
      EXPECT_LT(deepest[cell], slack) << cell;
    }
    ground += is_ground;
    left += !is_ground;
  }
  EXPECT_GT(ground, 800u);
  EXPECT_GT(left, 5u);
}

TEST(SidePlan, linksStayClearOfTheBliskWhereverTheyAreSampled) {
  const SidePlan& plan = planned();
  std::size_t samples = 0;
  for (std::size_t p = 1; p < plan.path.size(); ++p) {
    if (plan.grinds[p] || plan.grinds[p - 1]) continue;
    const Motion motion(plan.path[p - 1], plan.path[p]);
    constexpr int kSteps = 40;
    for (int k = 0; k <= kSteps; ++k, ++samples) {
      const Pose pose = motion.at(static_cast<double>(k) / kSteps);
      ASSERT_FALSE(collide(*task().blisk, *task().parts[0].tree, pose)) << "motion to " << p;
    }
  }
  EXPECT_GT(samples, 500u);
}

TEST(SidePlan, addsOnlyToWhatEarlierToolsLeave) {
  const SidePlan& first = planned();
  Judge judge(task().blisk, task().parts, task().blades.blade_of_triangle, task().rules, 2);
  const SidePlan second =
      planSide(judge, task().grid, {}, task().seat, {.threads = 2}, {first.points, first.path.size()});
  EXPECT_TRUE(second.path.empty());  // the first plan ended because this tool grinds no more
  EXPECT_EQ(groundShare(second), groundShare(first));

  std::vector<GroundPoint> half = first.points;
  for (std::size_t cell = half.size() / 2; cell < half.size(); ++cell) half[cell] = {};
  const SidePlan rest = planSide(judge, task().grid, {}, task().seat, {.threads = 2}, {half, 1'000'000});
  EXPECT_FALSE(rest.path.empty());
  EXPECT_NEAR(groundShare(rest), groundShare(first), 0.01);
  std::size_t by_first = 0, by_second = 0;
  for (const GroundPoint& point : rest.points) {
    by_first += point.isTouched() && point.pose < 1'000'000;
    by_second += point.isTouched() && point.pose >= 1'000'000;
    EXPECT_LT(point.pose, 1'000'000 + rest.path.size());
  }
  EXPECT_GT(by_first, half.size() / 4);
  EXPECT_GT(by_second, half.size() / 4);
}

TEST(SidePlan, isTheSameForOneThread) {
  const SidePlan alone = task().plan(1);
  ASSERT_EQ(alone.path.size(), planned().path.size());
  for (std::size_t p = 0; p < alone.path.size(); ++p) {
    ASSERT_EQ(alone.path[p].translation, planned().path[p].translation) << p;
    ASSERT_EQ(alone.path[p].rotation, planned().path[p].rotation) << p;
  }
}

TEST(GroundWidth, vs_bruteForceOnCircles) {
  // A segment of the belt's width is lowered onto a circle until it is `depth` deep at its deepest point.
  std::mt19937 random(12);
  std::uniform_real_distribution<double> width(1.0, 30.0), depth(0.005, 0.2), log_radius(0.5, 4.0);
  int narrower = 0, edges = 0;
  for (int i = 0; i < 300; ++i) {
    const double belt = width(random), d = depth(random), radius = std::pow(10.0, log_radius(random));
    const double curvature = (i % 2 == 0 ? 1.0 : -1.0) / radius;
    if (radius < 4.0 * belt) continue;  // the formula is for small slopes
    constexpr int kPoints = 20'001;
    double ground = 0.0;
    const double at_edge = 0.125 * belt * belt * curvature;  // how far the surface falls from middle to edge
    const double highest = std::max(0.0, -at_edge);
    for (int k = 0; k < kPoints; ++k) {
      const double x = belt * (static_cast<double>(k) / (kPoints - 1) - 0.5);
      const double height = -0.5 * curvature * x * x;
      if (height >= highest - d) ground += belt / kPoints;
    }
    const bool on_edges = curvature < 0.0 && ground < 0.999 * belt;
    const double expected = on_edges ? 0.5 * ground : ground;
    EXPECT_NEAR(groundWidth(curvature, belt, d), expected, 1e-3 * belt)
        << belt << ' ' << d << ' ' << curvature;
    narrower += ground < 0.999 * belt;
    edges += on_edges;
  }
  EXPECT_GT(narrower, 50);
  EXPECT_GT(edges, 20);
  EXPECT_DOUBLE_EQ(groundWidth(0.0, 20.0, 0.1), 20.0);
}

TEST(PassLines, reachEachWantedCell) {
  // Half of a cylinder, with its axis along the columns.
  constexpr double kRadius = 40.0;
  SurfaceGrid grid{30, 60, {}};
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double angle = M_PI * (static_cast<double>(column) + 0.5) / static_cast<double>(grid.columns);
      const Vec3 normal(std::cos(angle), std::sin(angle), 0.0);
      grid.points.push_back(
          {kRadius * normal + static_cast<double>(row) * Vec3::UnitZ(), normal, Vec3::UnitZ()});
    }
  }
  const PassWidth width{.belt_width = 8.0, .scallop = 0.5, .part = 1.0};
  const double reach = std::sqrt(2.0 * width.scallop * kRadius);  // on either side of a pass
  std::mt19937 random(3);
  for (const double share : {1.0, 0.2, 0.01}) {
    std::vector<bool> wanted(grid.points.size());
    for (std::size_t cell = 0; cell < wanted.size(); ++cell) {
      wanted[cell] = std::uniform_real_distribution<double>(0.0, 1.0)(random) < share;
    }
    for (const bool towards_tip : {true, false}) {
      const auto lines = passLines(grid, wanted, towards_tip, width);
      const double across = towards_tip ? reach : 0.5 * width.belt_width;  // a row is straight
      std::size_t cells = 0;
      for (const PassLine& line : lines) cells += line.size();
      for (std::size_t cell = 0; cell < wanted.size(); ++cell) {
        if (!wanted[cell]) continue;
        bool is_reached = false;
        for (const PassLine& line : lines) {
          for (const std::size_t on : line) {
            const bool abreast = towards_tip ? on / grid.columns == cell / grid.columns
                                             : on % grid.columns == cell % grid.columns;
            const double distance = (grid.points[on].point - grid.points[cell].point).norm();
            is_reached = is_reached || (abreast && distance <= across);
          }
        }
        EXPECT_TRUE(is_reached) << cell << ' ' << share;
      }
      EXPECT_LT(cells, grid.points.size() / 2);
      EXPECT_GT(cells, 0u);
    }
  }
}

TEST(Home, theToolMayTurnFreelyThereAndOnTheWaysBetween) {
  Judge judge(task().blisk, task().parts, task().blades.blade_of_triangle, task().rules);
  const Home home(judge);
  const double tool = 64.5, blisk = 60.0;  // at least; from the tool's origin, and from the blisk's centre
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  const auto anyPose = [&] {
    return Pose{Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                    .normalized()
                    .toRotationMatrix(),
                {40.0 * normal(random), 40.0 * normal(random), 40.0 * normal(random)}};
  };
  std::size_t between = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose from = home.of(anyPose()), to = home.of(anyPose());
    std::vector<Pose> way = home.between(from, to);
    between += way.size();
    way.insert(way.begin(), from);
    way.push_back(to);
    for (std::size_t k = 1; k < way.size(); ++k) {
      for (double part = 0.0; part <= 1.0; part += 0.125) {
        const Vec3 origin = way[k - 1].translation + part * (way[k].translation - way[k - 1].translation);
        EXPECT_GT(origin.norm(), tool + blisk);
      }
    }
  }
  EXPECT_GT(between, 100u);
}

}  // namespace
}  // namespace octoblisk::demos
