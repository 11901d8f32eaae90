// Repaired paths, judged again by every triangle pair.
#include "repair/path_repair.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "demos/block.h"
#include "models/shared_tree.h"
#include "repair/repair_report.h"
#include "shared/brute_force.h"

namespace octoblisk::demos {
namespace {

/// The tool's arm points up.
Pose standing(double x, double y, double z) {
  Pose pose;
  pose.rotation.col(0) = Vec3::UnitZ();
  pose.rotation.col(1) = Vec3::UnitX();
  pose.rotation.col(2) = Vec3::UnitY();
  pose.translation = Vec3(x, y, z);
  return pose;
}

/// A floor with its top at z = 0, with a ridge across it from x = -3 to 3 and up to z = 4.
TriangleMesh ridge() {
  return joined(moved(block({40, 20, 5}, 4), {0, 0, -5}), moved(block({3, 19, 3}, 3), {0, 0, 1}));
}

class PathRepairOver : public ::testing::Test {
 protected:
  PathRepair repaired(const TriangleMesh& solid, const std::vector<Pose>& path, const ChangeLimits& limits,
                      int threads = 0) {
    judge_ = std::make_unique<Judge>(treeOf(solid), std::vector<ToolPart>{{"bit", treeOf(bit_)}},
                                     std::vector<int>(solid.triangleCount(), 0),
                                     VerdictRules{.ground_blade = 0, .near_miss = 0.0}, threads);
    return repairPath(*judge_, path, directionsOffSurface(*judge_, path), limits);
  }

  const TriangleMesh bit_ = block({1, 1, 1}, 2);
  std::unique_ptr<Judge> judge_;
};

TEST_F(PathRepairOver, aRidgeGoesOverItSmoothlyAndTouchesNothing) {
  const TriangleMesh solid = ridge();
  std::vector<Pose> path;
  for (int x = -20; x <= 20; ++x) path.push_back(standing(x, 0.2, 1.5));
  const ChangeLimits limits = {
      .tilt = 10, .slide = 4, .retract = 10, .retract_grid = 0.2, .retract_per_pose = 1.5};
  const PathRepair repair = repaired(solid, path, limits);
  ASSERT_EQ(repair.path.size(), path.size());
  EXPECT_TRUE(repair.isFree());
  EXPECT_EQ(repair.interferedBefore(), 9u) << "the bit is 2 wide, the ridge 6";
  EXPECT_EQ(repair.posesLeft() + repair.motionsLeft(), 0u);
  EXPECT_GT(repair.changed(), 9u) << "it also lifts and lowers the tool";
  EXPECT_LT(repair.changed(), 29u) << "no more than necessary";
  EXPECT_TRUE(describeLeft(repair, judge_->parts(), BodyNames(1)).empty());
  for (std::size_t p = 0; p < path.size(); ++p) {
    EXPECT_TRUE(testing::bruteForcePairs(solid, bit_, repair.path[p]).empty()) << "pose " << p;
    const bool touched = !testing::bruteForcePairs(solid, bit_, path[p]).empty();
    EXPECT_EQ(repair.poses[p].before.obstacle.has_value(),
              touched || std::abs(path[p].translation.x()) < 2.0);
    const Change& change = repair.poses[p].change;
    if (change.isNone()) {
      EXPECT_EQ(repair.path[p].translation, path[p].translation) << "must be the same to the last bit";
    }
    if (p == 0) continue;
    const Change& last = repair.poses[p - 1].change;
    EXPECT_LE(std::abs(change.tilt - last.tilt), limits.tilt_per_pose + 1e-9);
    EXPECT_LE(std::abs(change.slide - last.slide), limits.slide_per_pose + 1e-9);
    EXPECT_LE(std::abs(change.retract - last.retract), limits.retract_per_pose + 1e-9);
    const Motion motion(repair.path[p - 1], repair.path[p]);
    for (int k = 1; k < 20; ++k) {
      ASSERT_TRUE(testing::bruteForcePairs(solid, bit_, motion.at(k / 20.0)).empty())
          << "on the way to " << p;
    }
  }
  // At least 3.5 mm are needed.
  double most = 0.0;
  for (const PoseRepair& pose : repair.poses) most = std::max(most, pose.change.retract);
  EXPECT_GT(most, 3.5);
  EXPECT_LT(most, 8.0) << "blocked motions once caused more retraction than necessary";

  const PathRepair alone = repaired(solid, path, limits, 1);
  for (std::size_t p = 0; p < path.size(); ++p) {
    EXPECT_EQ(alone.path[p].translation, repair.path[p].translation) << "whatever the number of threads";
    EXPECT_EQ(alone.path[p].rotation, repair.path[p].rotation);
  }
}

TEST_F(PathRepairOver, whatCannotBeRepairedIsLeftAndNamed) {
  const TriangleMesh solid = ridge();
  // Ten millimetres below the floor's top, no change within two millimetres is free.
  const std::vector<Pose> path = {standing(-20, 0, 3.0), standing(-18, 0, -5.0), standing(-16, 0, 3.0)};
  const ChangeLimits limits = {.tilt = 4, .slide = 2, .retract = 2, .retract_per_pose = 2};
  const PathRepair repair = repaired(solid, path, limits);
  EXPECT_FALSE(repair.isFree());
  EXPECT_EQ(repair.posesLeft(), 1u);
  const auto left = describeLeft(repair, judge_->parts(), BodyNames(1));
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0], "pose 1: bit wholly inside");
  EXPECT_EQ(repair.poses[1].asked, ChangeGrid(limits).size()) << "all was tried";
}

TEST_F(PathRepairOver, aWallBetweenTwoFreePosesIsNotPassedThrough) {
  const TriangleMesh wall = block({0.01, 20, 20}, 3);
  const std::vector<Pose> path = {standing(-3, 0, 0), standing(3, 0, 0), standing(6, 0, 0)};
  const ChangeLimits limits = {.tilt = 0, .slide = 0, .retract = 1, .retract_per_pose = 1};
  const PathRepair repair = repaired(wall, path, limits);
  EXPECT_EQ(repair.posesLeft(), 0u);
  EXPECT_EQ(repair.motionsLeft(), 1u);
  EXPECT_FALSE(repair.isFree());
  const auto left = describeLeft(repair, judge_->parts(), BodyNames(1));
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0], "motion to pose 1: bit on hub or shroud");
}

/// A floor to be ground, with its top at z = 0 and a low step on it that must not be touched.
struct FloorWithStep {
  TriangleMesh floor = moved(block({40, 20, 5}, 4), {0, 0, -5});
  TriangleMesh mesh = joined(floor, moved(block({0.5, 11.25, 0.04}, 2), {0, 8.75, 0.041}));
  std::vector<int> blades = std::vector<int>(mesh.triangleCount(), 0);

  FloorWithStep() { std::fill_n(blades.begin(), floor.triangleCount(), 1); }
};

TEST_F(PathRepairOver, keepsContactWhereAChangeCanAndNamesWhatLostIt) {
  const FloorWithStep ground;
  std::vector<Pose> path;
  for (int x = -8; x <= 8; ++x) path.push_back(standing(x, 0, 0.95));
  Judge judge(treeOf(ground.mesh), {{"bit", treeOf(bit_)}}, ground.blades,
              {.ground_blade = 1, .max_depth = 0.1, .near_miss = 0.0});
  const auto repaired = [&](const ChangeLimits& limits, bool keep_contact) {
    return repairPath(judge, path, directionsOffSurface(judge, path), limits, keep_contact);
  };
  const ChangeLimits limits = {.tilt = 0, .slide = 6, .retract = 2};
  const PathRepair keeping = repaired(limits, true), least = repaired(limits, false);
  EXPECT_EQ(keeping.working(), path.size());
  EXPECT_EQ(keeping.interferedBefore(), 3u);
  EXPECT_TRUE(keeping.isFree());
  EXPECT_EQ(keeping.contactsLost(), 0u) << describeLost(keeping);
  EXPECT_TRUE(least.isFree());
  EXPECT_EQ(least.contactsLost(), 5u) << "a lift is cheaper than a slide past the step";
  EXPECT_EQ(describeLost(least), "poses 6-10");
  for (std::size_t p = 0; p < path.size(); ++p) {
    const bool touches = !testing::bruteForcePairs(ground.floor, bit_, keeping.path[p]).empty();
    EXPECT_TRUE(touches) << p;
    EXPECT_EQ(testing::bruteForcePairs(ground.floor, bit_, least.path[p]).empty(), least.hasLostContact(p));
  }
  EXPECT_LE(keeping.poses[8].change.slide, -4.0);
  EXPECT_EQ(least.poses[8].change.slide, 0.0);
  // If no slide is left, the contact is lost, and the path is still repaired.
  const PathRepair must_lose = repaired({.tilt = 0, .slide = 2, .retract = 2}, true);
  EXPECT_TRUE(must_lose.isFree());
  EXPECT_EQ(must_lose.contactsLost(), 3u) << "no more than necessary";
}

TEST_F(PathRepairOver, refusesAnEmptyPath) { EXPECT_THROW(repaired(ridge(), {}, {}), std::invalid_argument); }

}  // namespace
}  // namespace octoblisk::demos
