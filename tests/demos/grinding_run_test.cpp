// Runs along a path: the motions between the poses, compared with closed forms; stops; threads.
#include "grinding/grinding_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "demos/block.h"
#include "grinding/motion_check.h"
#include "io/progress_bar.h"
#include "models/shared_tree.h"
#include "report/grinding_replay.h"
#include "report/grinding_report.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

using MotionOutcome = MotionReport::Outcome;

/// One part against a mesh that is blade `blade`; no blade is ground.
GrindingJob jobOf(const TriangleMesh& blisk, int blade, const TriangleMesh& part, std::vector<Pose> path) {
  GrindingJob job;
  job.blisk = treeOf(blisk);
  job.blades.count = std::max(blade, 0);
  job.blades.blade_of_triangle.assign(blisk.triangleCount(), blade);
  job.parts = {{"part", treeOf(part)}};
  job.rules.ground_blade = 0;
  job.rules.near_miss = 0.2;
  job.path = std::move(path);
  job.threads = 2;
  return job;
}

TEST(GrindingRun, aMotionThroughAThinWallHitsItWhereItStands) {
  constexpr double kWall = 0.01, kPart = 0.5, kFrom = -3.0, kTo = 3.0;
  const GrindingRun run = runGrinding(jobOf(block({kWall, 5, 5}, 2), 0, block({kPart, kPart, kPart}, 2),
                                            {at(-4, 0, 0), at(kFrom, 0, 0), at(kTo, 0.1, 0), at(4, 0, 0)}));
  ASSERT_EQ(run.poses.size(), 4u);
  EXPECT_EQ(run.count(Verdict::clear), 4u);
  EXPECT_FALSE(run.poses[0].motion.has_value());
  EXPECT_EQ(run.poses[1].motion->outcome, MotionOutcome::free);
  EXPECT_EQ(run.poses[1].motion->fraction, 1.0);
  EXPECT_EQ(run.poses[3].motion->outcome, MotionOutcome::free);
  const MotionReport& hit = *run.poses[2].motion;
  EXPECT_EQ(hit.outcome, MotionOutcome::hit);
  const double touches_at = (-kWall - kPart - kFrom) / (kTo - kFrom);
  EXPECT_LE(hit.fraction, touches_at);
  EXPECT_GE(hit.fraction, touches_at - 1.2 * kMotionTolerance / (kTo - kFrom));
  EXPECT_EQ(hit.at.blade, 0);
  EXPECT_NEAR(hit.at.contact.point_on_a.x(), -kWall, 1e-9);
  EXPECT_TRUE(run.interferes());
  EXPECT_NEAR(run.poses[1].clearance->contact.distance, -kWall - kPart - kFrom, 1e-9);
}

TEST(GrindingRun, aTurnHitsWhereTheBarMeetsThePostsCorner) {
  constexpr double kHalf = 0.1, kFar = 3.0;
  TriangleMesh post = block({kHalf, kHalf, 1}, 1);
  std::vector<Vec3> vertices = post.vertices();
  for (Vec3& vertex : vertices) vertex.y() += kFar;
  post = TriangleMesh(vertices, post.triangles());
  const double turn = 2.0 * std::numbers::pi / 3.0;
  Pose turned;
  turned.rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  const GrindingRun run = runGrinding(jobOf(post, 0, block({5, kHalf, kHalf}, 2), {Pose(), turned}));
  // The corner (half, far - half) is as far from the bar's axis as the bar is thick.
  const double x = kHalf, y = kFar - kHalf;
  const double angle = std::acos(kHalf / std::hypot(x, y)) - std::atan2(x, y);
  ASSERT_EQ(run.poses[1].motion->outcome, MotionOutcome::hit);
  EXPECT_NEAR(run.poses[1].motion->fraction, angle / turn, 1e-3);
  EXPECT_LE(run.poses[1].motion->fraction, angle / turn);
}

TEST(GrindingRun, whatMayTouchMustNotGetThroughBetweenPoses) {
  for (const double far : {3.0, 300.0, 30'000.0}) {
    GrindingJob job =
        jobOf(block({1, 5, 5}, 2), 1, block({0.5, 0.5, 0.5}, 2), {at(-far, 0, 0), at(far, 0, 0)});
    job.rules.ground_blade = 1;
    const GrindingRun run = runGrinding(job);
    EXPECT_EQ(run.poses[1].motion->outcome, MotionOutcome::too_deep) << far;
    EXPECT_NEAR(run.poses[1].motion->fraction, 0.5, 1.5 / (2.0 * far)) << far;
    EXPECT_TRUE(run.interferes()) << far;
    EXPECT_FALSE(run.poses[0].clearance.has_value()) << "nothing is forbidden";
  }
}

/// Too long to measure everywhere. The blisk is open, so nothing is proved.
TEST(GrindingRun, aMotionMeasuredTooRarelyIsNotProved) {
  const TriangleMesh wall = block({1, 5, 1e5}, 2);
  std::vector<TriangleMesh::Indices> open = wall.triangles();
  open.erase(open.begin());
  GrindingJob job =
      jobOf(wall, 1, block({0.5, 0.5, 0.5}, 2), {at(-1.45, 0, -5e4), at(-1.45, 0, 5e4), at(-9, 0, 5e4)});
  job.blisk = treeOf(TriangleMesh(wall.vertices(), open));
  job.blades.blade_of_triangle.pop_back();
  job.rules.ground_blade = 1;
  const GrindingRun run = runGrinding(job);
  EXPECT_EQ(run.poses[1].motion->outcome, MotionOutcome::not_proved);
  EXPECT_TRUE(run.interferes());
  const std::vector<ReplayFinding> findings = grindingReplay(run).tracks.front().findings;
  ASSERT_FALSE(findings.empty());
  for (const ReplayFinding& finding : findings) EXPECT_TRUE(std::isfinite(finding.value.value()));
}

TEST(GrindingRun, aMotionFromATooDeepPoseIsNotCalledFree) {
  GrindingJob job = jobOf(block({1, 5, 5}, 2), 1, block({0.5, 0.5, 0.5}, 2), {at(-1.2, 0, 0), at(-3, 0, 0)});
  job.rules.ground_blade = 1;
  const GrindingRun run = runGrinding(job);
  EXPECT_EQ(run.poses[0].verdict, Verdict::interference);
  EXPECT_EQ(run.poses[1].motion->outcome, MotionOutcome::not_checked);
}

TEST(GrindingRun, aMotionToOrFromATouchIsNotCalledFree) {
  const std::vector<Pose> path = {at(1.2, 0, 0), at(3, 0, 0), at(3, 3, 0)};
  const GrindingRun run = runGrinding(jobOf(block({1, 5, 5}, 2), 1, block({0.5, 0.5, 0.5}, 2), path));
  EXPECT_EQ(run.poses[0].verdict, Verdict::interference);
  EXPECT_EQ(run.poses[1].motion->outcome, MotionOutcome::not_checked);
  EXPECT_EQ(run.poses[1].motion->fraction, 0.0);
  EXPECT_EQ(run.poses[2].motion->outcome, MotionOutcome::free);
  EXPECT_THAT(summaryText(run),
              ::testing::HasSubstr("not checked, because a part interferes at one of the poses: 1\n"));
}

TEST(GrindingRun, theDepthIsProvedOfTheMovesOfWhichItIsSaid) {
  // Depths 0.05, 0.05, 0.3 and away: one motion slides, one becomes too deep, one leaves.
  const std::vector<Pose> path = {at(-1.45, 0, 0), at(-1.45, 3, 0), at(-1.2, 3, 0), at(-3, 3, 0)};
  const TriangleMesh wall = block({1, 5, 5}, 2), bit = block({0.5, 0.5, 0.5}, 2);
  GrindingJob job = jobOf(wall, 1, bit, path);
  job.rules.ground_blade = 1;
  const GrindingRun run = runGrinding(job);
  EXPECT_TRUE(run.poses[1].motion->depth_proved);
  EXPECT_FALSE(run.poses[2].motion->depth_proved) << "it ends too deep";
  EXPECT_FALSE(run.poses[3].motion->depth_proved) << "it begins too deep";
  EXPECT_EQ(run.depthsProved(), 1u);
  EXPECT_EQ(run.motionCount(), 3u);
  EXPECT_GE(run.depthBound(), 0.3);
  EXPECT_LE(run.depthBound(), 1.1 * 0.301) << "within a tenth of the measured depth";
  EXPECT_THAT(summaryText(run),
              ::testing::HasSubstr(
                  "proved within the limit on 1 of 3 motions; not proved on the others, but at most "));

  std::vector<TriangleMesh::Indices> open = wall.triangles();
  open.erase(open.begin());
  job.blisk = treeOf(TriangleMesh(wall.vertices(), open));
  job.blades.blade_of_triangle.pop_back();
  const GrindingRun of_open = runGrinding(job);
  EXPECT_EQ(of_open.depthsProved(), 0u) << "nothing is proved for an open blisk";
  EXPECT_LT(of_open.depthBound(), 3.0) << "the depths at the poses still count";
}

TEST(GrindingRun, aMotionThatIsNotProvedFreeCountsAsInterference) {
  GrindingRun run;
  run.poses.resize(2);
  run.poses[1].motion = MotionReport{};
  EXPECT_FALSE(run.interferes());
  run.poses[1].motion->outcome = MotionOutcome::not_proved;
  EXPECT_TRUE(run.interferes());
}

TEST(GrindingRun, aSlideAtTheIntendedDepthIsFree) {
  constexpr double kDepth = 0.05, kSlide = 3.0;
  GrindingJob job = jobOf(block({1, 5, 5}, 2), 1, block({0.5, 0.5, 0.5}, 2),
                          {at(-1.5 + kDepth, 0, 0), at(-1.5 + kDepth, kSlide, 0)});
  job.rules.ground_blade = 1;
  const GrindingRun run = runGrinding(job);
  EXPECT_EQ(run.count(Verdict::intended_contact), 2u);
  const MotionReport& motion = *run.poses[1].motion;
  EXPECT_EQ(motion.outcome, MotionOutcome::free);
  EXPECT_GE(motion.depth_bound, kDepth - 1e-3);
  EXPECT_LE(motion.depth_bound, kDepth + 0.5 * kDepthStep + 1e-3);
  EXPECT_FALSE(run.interferes());
}

/// Random poses in a fan of blades.
GrindingJob randomJob(int poses) {
  const auto fan = testing::fan(9, 10);
  GrindingJob job = jobOf(*fan, 1, *testing::torus(0.3, 0.08, 20, 12), {});
  std::mt19937_64 random(71);
  for (int& blade : job.blades.blade_of_triangle) blade = static_cast<int>(random() % 3);
  job.blades.count = 2;
  job.parts.push_back({"box", treeOf(testing::boxMesh({0.2, 0.1, 0.1}))});
  for (int i = 0; i < poses; ++i) job.path.push_back(testing::randomPose(random, 1.6));
  return job;
}

TEST(GrindingRun, answersDoNotDependOnTheNumberOfThreads) {
  GrindingJob job = randomJob(150);
  job.find_ground_blade = true;
  std::vector<GrindingRun> runs;
  for (const int threads : {1, 3}) {
    job.threads = threads;
    runs.push_back(runGrinding(job));
  }
  EXPECT_NE(runs[0].job.rules.ground_blade, 0);
  EXPECT_EQ(runs[0].job.rules.ground_blade, runs[1].job.rules.ground_blade);
  ASSERT_EQ(runs[0].poses.size(), runs[1].poses.size());
  std::size_t hit = 0;
  for (std::size_t i = 0; i < runs[0].poses.size(); ++i) {
    const PoseReport &one = runs[0].poses[i], &other = runs[1].poses[i];
    ASSERT_EQ(one.verdict, other.verdict);
    ASSERT_EQ(one.touches.size(), other.touches.size());
    ASSERT_EQ(one.part_clearances, other.part_clearances);
    ASSERT_EQ(one.clearance->contact.point_on_a, other.clearance->contact.point_on_a);
    if (i == 0) continue;
    ASSERT_EQ(one.motion->outcome, other.motion->outcome);
    ASSERT_EQ(one.motion->fraction, other.motion->fraction);
    ASSERT_EQ(one.motion->depth_bound, other.motion->depth_bound);
    hit += one.motion->outcome == MotionOutcome::hit;
  }
  EXPECT_GT(hit, 10u);
}

TEST(GrindingRun, theGroundBladeIsThatTouchedAtTheMostPoses) {
  const GrindingJob job = randomJob(150);
  std::map<int, int> poses_of_blade;
  for (const Pose& pose : job.path) {
    const TriangleMesh& belt = job.parts.front().tree->mesh();
    std::set<int> touched;
    for (const TrianglePair& pair : testing::bruteForcePairs(job.blisk->mesh(), belt, pose)) {
      touched.insert(job.blades.blade_of_triangle[pair.a]);
    }
    for (const int blade : touched) ++poses_of_blade[blade];
  }
  ASSERT_GT(poses_of_blade[1], 20);
  ASSERT_GT(poses_of_blade[2], 20);
  ASSERT_NE(poses_of_blade[1], poses_of_blade[2]);
  EXPECT_EQ(bladeTouchedMost(*job.blisk, *job.parts.front().tree, job.blades.blade_of_triangle, job.path),
            poses_of_blade[1] > poses_of_blade[2] ? 1 : 2);
  const RunWatch stopped{.stop = [] { return true; }};
  EXPECT_FALSE(bladeTouchedMost(*job.blisk, *job.parts.front().tree, job.blades.blade_of_triangle, job.path,
                                1, stopped));
}

TEST(GrindingRun, whatHitsBetweenPosesIsFoundByManySmallSteps) {
  const GrindingJob job = randomJob(80);
  const GrindingRun run = runGrinding(job);
  const ClusteredOctree& blisk = *job.blisk;
  int hit = 0, free = 0;
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    const auto touchesSomewhere = [&](double up_to) {
      const Motion motion(job.path[i - 1], job.path[i]);
      for (int k = 0; k <= 150; ++k) {
        const Pose pose = motion.at(up_to * k / 150.0);
        for (const ToolPart& part : job.parts) {
          if (distance(blisk, *part.tree, pose).distance == 0.0) return true;
        }
      }
      return false;
    };
    const bool ends_touch = run.poses[i - 1].clearance->contact.distance == 0.0 ||
                            run.poses[i].clearance->contact.distance == 0.0;
    const MotionReport& motion = *run.poses[i].motion;
    if (ends_touch) continue;
    (motion.outcome == MotionOutcome::free ? free : hit) += 1;
    ASSERT_NE(motion.outcome == MotionOutcome::free && touchesSomewhere(1.0), true) << "pose " << i;
    ASSERT_FALSE(touchesSomewhere(motion.fraction)) << "pose " << i;
  }
  EXPECT_GT(hit, (hit + free) * 3 / 10);
  EXPECT_GT(free, 3);
}

TEST(GrindingRun, stoppedItKeepsThePosesDone) {
  GrindingJob job = randomJob(150);
  job.threads = 1;
  std::size_t done = 0;
  RunWatch watch;
  watch.progress = [&](const std::string&, std::size_t poses) { done = poses; };
  watch.stop = [&] { return done > 0; };
  const GrindingRun run = runGrinding(job, watch);
  EXPECT_TRUE(run.isPartial());
  EXPECT_EQ(run.job.path.size(), 150u);
  EXPECT_EQ(run.poses.size(), done);
  EXPECT_LT(done, 150u);
  const GrindingRun whole = runGrinding(job);
  EXPECT_FALSE(whole.isPartial());
  for (std::size_t i = 0; i < done; ++i) EXPECT_EQ(run.poses[i].verdict, whole.poses[i].verdict);
}

TEST(ProgressBar, rateAndTimeLeft) {
  EXPECT_EQ(rateAndTimeLeft(0, 10, 1.0), "");
  EXPECT_EQ(rateAndTimeLeft(500, 1000, 5.0), "100 per second, 5 s left");
  EXPECT_EQ(rateAndTimeLeft(10, 1010, 4.0), "2.5 per second, 6 min 40 s left");
  EXPECT_EQ(rateAndTimeLeft(1, 3601, 2.0), "0.5 per second, 2 h 0 min 0 s left");
}

}  // namespace
}  // namespace octoblisk::demos
