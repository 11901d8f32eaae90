// The robot experiment: its layout, its timed path, the paper's boxes, and the run itself.
#include "paper/robot/robot_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>

#include "demos/paper_report.h"
#include "io/number_text.h"
#include "models/belt_grinder.h"
#include "models/blisk.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "paper/robot/robot_report.h"
#include "paper/robot/timed_path.h"
#include "shared/meshes.h"
#include "toolpath/grinding_path.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The default blisk, coarse, and the default grinder.
const RobotScene& coarseScene() {
  static const RobotScene scene = [] {
    RobotScene made;
    made.blisk = treeOf(makeDefaultBlisk(10'000).mesh);
    made.blades = findBlades(made.blisk->mesh());
    BeltParameters belt;
    made.tool = {{"belt", treeOf(makeBelt(belt))},
                 {"contact wheel", treeOf(makeContactWheel(belt))},
                 {"drive wheel", treeOf(makeDriveWheel(belt))},
                 {"arm", treeOf(makeArm(belt))}};
    made.clouds.resize(static_cast<std::size_t>(made.blades.count) + 1);  // hub and blades: their centroids
    for (std::size_t t = 0; t < made.blisk->mesh().triangleCount(); ++t) {
      const auto [a, b, c] = made.blisk->mesh().triangle(t);
      made.clouds[static_cast<std::size_t>(made.blades.blade_of_triangle[t])].push_back((a + b + c) / 3.0);
    }
    return made;
  }();
  return scene;
}

std::vector<Pose> coarsePathOf(const GrindingPathOptions& options) {
  return makeGrindingPath(coarseScene().blisk->mesh(), coarseScene().blades, options);
}

/// About 60 mm along a blade, pressed into it to this depth.
RobotScene sceneOfShortPath(double depth) {
  RobotScene scene = coarseScene();
  GrindingPathOptions options;
  options.passes = 1;
  options.poses_per_pass = 12;
  options.retract_poses = 1;
  options.retract = 10.0;
  options.depth = depth;
  scene.path = coarsePathOf(options);
  return scene;
}

CellLayout layoutOf(const RobotScene& scene) {
  StandOptions stand;
  stand.turntable_steps = 12;
  return chooseLayout({}, scene.path, scene.blisk->mesh().bounds(), stand);
}

/// Fast enough for a test: about 60 ticks.
RobotRunOptions quickOptions() {
  RobotRunOptions options;
  options.speed = 50.0;
  options.control_period = 0.03;
  options.steps_per_tick = 10;
  return options;
}

TEST(TimedPath, goesAtConstantSpeed_andSlowerWhereItTurns) {
  Pose turned;
  turned.translation = {30.0, 10.0, 0.0};
  turned.rotation = Eigen::AngleAxisd(1.0, Vec3::UnitZ()).toRotationMatrix();
  const TimedPath path({{Mat3::Identity(), {0.0, 0.0, 0.0}}, {Mat3::Identity(), {30.0, 0.0, 0.0}}, turned},
                       10.0, 0.25);
  EXPECT_DOUBLE_EQ(path.duration(), 3.0 + 4.0);
  EXPECT_TRUE(path.at(1.5).translation.isApprox(Vec3(15.0, 0.0, 0.0)));
  EXPECT_TRUE(path.at(5.0).translation.isApprox(Vec3(30.0, 5.0, 0.0)));
  const Mat3 half = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(path.at(5.0).rotation.isApprox(half, 1e-12));
  EXPECT_EQ(path.at(-1.0).translation.x(), 0.0);
  EXPECT_EQ(path.at(100.0).translation, turned.translation);
  EXPECT_THROW(TimedPath({}, 1.0, 1.0), std::invalid_argument);
  EXPECT_THROW(TimedPath({turned}, 0.0, 1.0), std::invalid_argument);
}

TEST(CellLayout, theDefaultPath_isReachedWithinLimits_withoutLeaps) {
  const SixAxisArm arm;
  const std::vector<Pose> path = coarsePathOf({});
  const CellLayout layout = chooseLayout(arm, path, coarseScene().blisk->mesh().bounds());
  EXPECT_GT(layout.margin, 0.2);
  Joints last = layout.start;
  for (const Pose& pose : path) {
    const Pose flange = layout.blisk_in_base * pose * layout.tool_in_flange.inverse();
    const Posture next = inverseKinematics(arm, flange, last);
    ASSERT_EQ(next.reach, Reach::reached);
    ASSERT_TRUE(withinLimits(arm, next.joints));
    ASSERT_LT((flangeAt(arm, next.joints).translation - flange.translation).norm(), 1e-6);
    ASSERT_LT((next.joints - last).cwiseAbs().maxCoeff(), 0.3);
    last = next.joints;
  }
}

TEST(CellLayout, saysHowFarTheArmGets_whereItCannotFollow) {
  StandOptions near, far;
  far.center.x() = 4000.0;
  const std::vector<Pose> path = coarsePathOf({});
  std::vector<Pose> path_with_far_pose = path;
  path_with_far_pose[7].translation *= 10.0;
  const Aabb& bounds = coarseScene().blisk->mesh().bounds();
  const auto expectPose = [&](const std::string& pose, const std::vector<Pose>& poses,
                              const StandOptions& stand) {
    try {
      chooseLayout({}, poses, bounds, stand);
      FAIL() << "it reached all poses";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("pose " + pose + " (counted from 0), which is out of reach"));
    }
  };
  expectPose("0", path, far);
  expectPose("7", path_with_far_pose, near);
  EXPECT_THROW(chooseLayout({}, {}, bounds), std::invalid_argument);
}

TEST(CellLayout, theToolsArm_pointsToTheFlange) {
  const Pose tool = toolInFlange(380.0);
  EXPECT_NEAR(tool.rotation.determinant(), 1.0, 1e-12);
  EXPECT_TRUE((tool * Vec3(380.0, 0.0, 0.0)).isZero(1e-12));
}

TEST(RobotRun, onASlowPath_theToolStaysNearIt_andNoTickIsLost) {
  const RobotScene scene = sceneOfShortPath(0.02);
  RobotRunOptions options = quickOptions();
  options.speed = 20.0;
  options.control_period = 0.04;
  const RobotRun run = runRobot(scene, layoutOf(scene), options);
  EXPECT_EQ(run.unreached_ticks, 0u);
  EXPECT_NEAR(static_cast<double>(run.ticks.size()) * options.control_period, run.duration,
              2.0 * options.control_period);
  EXPECT_GT(run.worst_position_error, 0.0);
  // At a steady rate the servos lag by (1 − 0.9) · 20 mm/s / 40 per second = 0.05 mm; slightly more at bends
  // and at the start, where the path begins at full speed.
  EXPECT_LT(run.mean_position_error, 0.1);
  EXPECT_LT(run.worst_position_error, 0.6);
  EXPECT_GT(run.least_margin_to_limits, 0.1);
  EXPECT_LT(run.worst_sensing_error, 0.2);
  EXPECT_GT(run.mean_sensing_error, 0.0);
}

TEST(RobotRun, aForcedCollision_isDetectedInTheLoop) {
  const RobotScene scene = sceneOfShortPath(3.0);
  const RobotRun run = runRobot(scene, layoutOf(scene), quickOptions());
  const auto ticks = run.ticks.size();
  EXPECT_GT(run.forbidden_ticks, ticks / 2);  // the wheel in the blade
  EXPECT_GT(run.touching_ticks, ticks / 2);
  EXPECT_LT(run.touching_ticks, ticks);
  for (const RobotMethod method : {RobotMethod::exact, RobotMethod::margin}) {
    ASSERT_TRUE(run.of(method).forbidden);
    const RobotAlarms& forbidden = *run.of(method).forbidden;
    EXPECT_LE(forbidden.missed, method == RobotMethod::margin ? 0u : 2u);
    EXPECT_EQ(forbidden.alarms, run.forbidden_ticks + forbidden.false_alarms - forbidden.missed);
  }
  EXPECT_FALSE(run.of(RobotMethod::traditional).forbidden);
}

TEST(RobotRun, withoutNoise_exactDetectionIsTheTruth) {
  const RobotScene scene = sceneOfShortPath(0.05);
  RobotRunOptions options = quickOptions();
  options.noise = {.encoder = 0.0, .position = 0.0, .direction = 0.0};
  options.margin = 0.5;
  const RobotRun run = runRobot(scene, layoutOf(scene), options);
  EXPECT_LT(run.worst_sensing_error, 1e-6);
  const RobotMethodResult& exact = run.of(RobotMethod::exact);
  EXPECT_EQ(exact.touch.missed + exact.touch.false_alarms, 0u);
  EXPECT_EQ(exact.forbidden->missed + exact.forbidden->false_alarms, 0u);
  EXPECT_EQ(exact.touch.alarms, run.touching_ticks);
  EXPECT_EQ(run.of(RobotMethod::margin).touch.missed, 0u);
  EXPECT_EQ(run.of(RobotMethod::yes_or_no).touch.missed + run.of(RobotMethod::yes_or_no).touch.false_alarms,
            0u);
  EXPECT_EQ(run.arm.ticks, run.arm.true_ticks);
  EXPECT_GT(run.touching_ticks, 0u);
}

TEST(RobotRun, isDeterministic_butForTimes) {
  const RobotScene scene = sceneOfShortPath(0.02);
  const CellLayout layout = layoutOf(scene);
  RobotRunOptions options = quickOptions();
  options.control_period = 0.1;
  const RobotRun first = runRobot(scene, layout, options), second = runRobot(scene, layout, options);
  options.noise.seed = 2;
  const RobotRun other = runRobot(scene, layout, options);
  ASSERT_EQ(first.ticks.size(), second.ticks.size());
  bool differs = false;
  for (std::size_t k = 0; k < first.ticks.size(); ++k) {
    ASSERT_EQ(first.ticks[k].position_error, second.ticks[k].position_error);
    ASSERT_EQ(first.ticks[k].sensing_error, second.ticks[k].sensing_error);
    ASSERT_EQ(first.ticks[k].alarm, second.ticks[k].alarm);
    ASSERT_EQ(first.ticks[k].touch, second.ticks[k].touch);
    differs |= first.ticks[k].sensing_error != other.ticks[k].sensing_error;
  }
  EXPECT_TRUE(differs);
}

TEST(RobotRun, wherePosesAreOutOfReach_theArmWaits_andItIsCounted) {
  RobotScene scene = sceneOfShortPath(0.02);
  const CellLayout layout = layoutOf(scene);
  Pose far = scene.path.back();
  far.translation *= 12.0;
  scene.path.push_back(far);
  RobotRunOptions options = quickOptions();
  options.speed = 2000.0;
  const RobotRun run = runRobot(scene, layout, options);
  EXPECT_GT(run.unreached_ticks, 0u);
  EXPECT_LT(run.unreached_ticks, run.ticks.size());
}

TEST(RobotRun, refusesBladesOfAnotherMesh_andOptionsOutOfRange) {
  RobotScene scene = sceneOfShortPath(0.02);
  const CellLayout layout = layoutOf(scene);
  RobotRunOptions options;
  options.control_period = 0.0;
  EXPECT_THROW(runRobot(scene, layout, options), std::invalid_argument);
  options = {};
  options.steps_per_tick = 0;
  EXPECT_THROW(runRobot(scene, layout, options), std::invalid_argument);
  RobotScene without_clouds = scene;
  without_clouds.clouds.clear();
  EXPECT_THROW(runRobot(without_clouds, layout), std::invalid_argument);
  scene.blades.blade_of_triangle.pop_back();
  EXPECT_THROW(runRobot(scene, layout), std::invalid_argument);
}

TEST(RobotSection, showsTheRunsBesideThePaper) {
  const RobotScene scene = sceneOfShortPath(0.02);
  const std::vector<Pose> lifted = sceneOfShortPath(-1.0).path;
  RobotRunOptions options = quickOptions();
  options.control_period = 0.1;
  double done = 0.0;
  const RobotReport report = runRobotExperiment(
      scene, lifted, options, [&](std::uint64_t) { return scene.clouds; },
      [&](double part) {
        EXPECT_GE(part, done);
        done = part;
      });
  EXPECT_EQ(done, 1.0);
  ASSERT_EQ(report.runs.size(), 3u);
  EXPECT_NE(report.runs[0].mean_sensing_error, report.runs[1].mean_sensing_error);
  EXPECT_LT(report.lifted.touching_ticks, report.runs[0].touching_ticks);

  const PaperReport written = reportOf("table4", "table4", report);
  const Section& section = written.document.sections[1];
  ASSERT_EQ(section.tables.size(), 6u);
  const Table& paper = section.tables[0];
  ASSERT_EQ(paper.rows.size(), 4u);  // range; least, median and greatest time
  EXPECT_EQ(paper.rows[0][5], "4608.00");
  EXPECT_EQ(paper.rows[0][6], "2534.40");
  EXPECT_EQ(paper.rows[1][7], "-18.39 %");
  EXPECT_EQ(paper.rows[2][5], "475.99");
  EXPECT_EQ(paper.rows[2][7], "-18.48 %");
  EXPECT_EQ(section.tables[1].name, "table4_seeds");
  ASSERT_EQ(report.seeds.count(), 32u);
  const double mean = std::accumulate(report.seeds.range.begin(), report.seeds.range.end(), 0.0) / 32.0;
  EXPECT_EQ(section.tables[1].rows[0][1], changeText(1.0, mean));
  EXPECT_EQ(written.plots.size(), 2u);
  const Table& alarms = section.tables[3];
  ASSERT_EQ(alarms.rows.size(), 2 * kRobotMethods);
  const RobotRun& last = report.lifted;
  EXPECT_THAT(alarms.rows[kRobotMethods][3],
              StartsWith(std::to_string(last.of(RobotMethod::traditional).touch.false_alarms) + " of " +
                         std::to_string(last.ticks.size() - last.touching_ticks)));
  for (const Table& table : section.tables) {
    for (const std::vector<std::string>& row : table.rows) {
      ASSERT_EQ(row.size(), table.columns.size()) << table.name;
    }
  }
  for (const RobotMethodResult& method : report.runs[0].methods) {
    EXPECT_LE(method.usual_seconds, method.worst_seconds + 1e-9);
    EXPECT_GT(method.mean_seconds, 0.0);
  }
}

TEST(RobotAlarms, count) {
  RobotAlarms alarms;
  alarms.count(true, true);
  alarms.count(true, false);
  alarms.count(true, false);
  alarms.count(false, true);
  alarms.count(false, false);
  EXPECT_EQ(alarms.alarms, 3u);
  EXPECT_EQ(alarms.false_alarms, 2u);
  EXPECT_EQ(alarms.missed, 1u);
}

}  // namespace
}  // namespace octoblisk::demos
