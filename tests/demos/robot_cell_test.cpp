// The arm in Bullet's world: its frames, its motors, and its contacts.
#include "paper/robot/robot_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "demos/robot_poses.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "paper/robot/arm_bodies.h"
#include "paper/robot/cell_layout.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

constexpr double kToolLength = 300.0;

/// A ring about y as the blisk in front of the arm, and two bars as the tool.
RobotCellSetup smallSetup() {
  RobotCellSetup setup;
  setup.blisk = treeOf(testing::torus(200.0, 60.0, 40, 24));
  setup.tool = {{"bar", treeOf(testing::boxMesh({60.0, 8.0, 12.0}))},
                {"cross bar", treeOf(testing::boxMesh({10.0, 60.0, 10.0}))}};
  StandOptions stand;
  setup.blisk_in_base = bliskInBase(stand, 0.3, 0.0);
  setup.tool_in_flange = toolInFlange(kToolLength);
  return setup;
}

Joints readyJoints() { return jointsOfDegrees(0.0, 10.0, 15.0, 0.0, 60.0, 0.0); }

TEST(RobotCell, framesOfBullet_equalForwardKinematics) {
  RobotCell cell(smallSetup());
  const SixAxisArm arm;
  std::mt19937_64 random(71);
  for (int i = 0; i < 50; ++i) {
    Joints joints;
    for (Eigen::Index j = 0; j < 6; ++j) joints[j] = testing::uniform(random, arm.least[j], arm.greatest[j]);
    cell.place(joints);
    const std::array<Pose, 6> expected = linkFrames(arm, joints);
    for (std::size_t link = 0; link < 6; ++link) {
      ASSERT_LT(apart(cell.linkFrame(link), expected[link]), 1e-8) << joints.transpose() << ", link " << link;
    }
    const Pose tool = cell.setup().blisk_in_base.inverse() * expected[5] * cell.setup().tool_in_flange;
    ASSERT_LT(apart(cell.toolInBlisk(), tool), 1e-8);
    ASSERT_LT(apart(cell.toolInBlisk(StateEstimate{joints, {}}), tool), 1e-8);
  }
}

TEST(RobotCell, framesOfBullet_equalForwardKinematics_whenItMoved) {
  RobotCell cell(smallSetup());
  cell.place(readyJoints());
  Joints to = readyJoints();
  to.array() += 0.01;
  cell.drive(readyJoints(), to, 0.05, 50, Joints::Zero());
  const Joints joints = cell.joints();
  EXPECT_GT((joints - readyJoints()).cwiseAbs().minCoeff(), 0.005);
  for (std::size_t link = 0; link < 6; ++link) {
    EXPECT_LT(apart(cell.linkFrame(link), linkFrames({}, joints)[link]), 1e-8) << "link " << link;
  }
}

TEST(RobotCell, atRest_theMotorsHoldTheArm) {
  RobotCell cell(smallSetup());
  cell.place(readyJoints());
  cell.drive(readyJoints(), readyJoints(), 0.2, 50, Joints::Zero());
  EXPECT_LT((cell.joints() - readyJoints()).cwiseAbs().maxCoeff(), 1e-7);
}

/// Lets the arm hold itself for a while, with joint 2 limited to a fraction of the torque that its weight
/// requires: computed directly, as the sum of weights times their distances in front of the axis.
double sagOfJoint2(double part) {
  RobotCellSetup setup = smallSetup();
  const Joints joints = readyJoints();
  const std::array<LinkBody, 6> bodies = linkBodies(setup.arm);
  const std::array<Pose, 6> frames = linkFrames(setup.arm, joints);
  double torque = 0.0;  // kg mm²/s²
  for (std::size_t link = 1; link < 6; ++link) {
    const Vec3 center = frames[link] * Vec3(0.5 * (bodies[link].from + bodies[link].to));
    torque += 9810.0 * bodies[link].mass * (center.x() - setup.arm.shoulder_offset);
  }
  const Vec3 tool = frames[5] * setup.tool_in_flange.translation;  // both bars are symmetric about it
  torque += 9810.0 * setup.tool_mass * (tool.x() - setup.arm.shoulder_offset);
  setup.servo.torque[1] = part * torque * 1e-6;  // N m

  RobotCell cell(setup);
  cell.place(joints);
  cell.drive(joints, joints, 0.1, 100, Joints::Zero());
  return cell.joints()[1] - joints[1];
}

TEST(RobotCell, joint2_holdsTheArm_withTheTorqueOfItsWeight_andNoLess) {
  EXPECT_NEAR(sagOfJoint2(1.01), 0.0, 1e-7);
  EXPECT_GT(sagOfJoint2(0.99), 1e-5);
}

TEST(RobotCell, withoutFeedforward_theToolLagsBySpeedOverGain) {
  RobotCellSetup setup = smallSetup();
  setup.servo.feedforward = 0.0;
  RobotCell cell(setup);
  Joints rate = Joints::Zero();
  rate[1] = 0.02;  // rad/s
  rate[4] = -0.01;
  cell.place(readyJoints());
  Joints from = readyJoints();
  constexpr double kPeriod = 0.004;
  for (int tick = 0; tick < 250; ++tick) {
    const Joints to = from + kPeriod * rate;
    cell.drive(from, to, kPeriod, 4, Joints::Zero());
    from = to;
  }
  for (Eigen::Index j = 0; j < 6; ++j) {
    EXPECT_NEAR(from[j] - cell.joints()[j], rate[j] / setup.servo.position_gain, 1e-5) << "joint " << j;
  }
}

TEST(RobotCell, encoderErrors_moveTheArm) {
  RobotCell cell(smallSetup());
  cell.place(readyJoints());
  Joints error = Joints::Zero();
  error[1] = 1e-3;
  cell.drive(readyJoints(), readyJoints(), 1.0, 250, error);
  EXPECT_NEAR(cell.joints()[1], readyJoints()[1] - 1e-3, 1e-6);
}

TEST(RobotCell, jointLimits_holdThoughTheCommandGoesBeyond) {
  RobotCellSetup setup = smallSetup();
  setup.arm.greatest[1] = readyJoints()[1] + 0.02;
  RobotCell cell(setup);
  cell.place(readyJoints());
  Joints to = readyJoints();
  to[1] += 0.2;
  cell.drive(readyJoints(), to, 0.5, 500, Joints::Zero());
  EXPECT_LT(cell.joints()[1], setup.arm.greatest[1] + 2e-3);
  EXPECT_GT(cell.joints()[1], setup.arm.greatest[1] - 2e-3);
}

TEST(RobotCell, detects_whatExactQueriesSay_whereTheToolIsThoughtToBe) {
  RobotCell cell(smallSetup());
  const RobotCellSetup& setup = cell.setup();
  const Pose flange_in_tool = setup.tool_in_flange.inverse();
  constexpr double kReach = 2.0;
  std::mt19937_64 random(72);
  int asked = 0, touching = 0, near = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose tool_in_blisk = testing::randomPose(random, 200.0);
    const Posture posture =
        inverseKinematics(setup.arm, setup.blisk_in_base * tool_in_blisk * flange_in_tool, readyJoints());
    if (posture.reach != Reach::reached) continue;
    const Joints before = cell.joints();
    const StateEstimate estimate{posture.joints, testing::randomPose(random, 1.0)};
    const Pose believed = cell.toolInBlisk(estimate);
    ASSERT_LT(apart(believed, tool_in_blisk * estimate.tool_error), 1e-5);
    for (const double reach : {0.0, kReach}) {
      const std::span<const CellContact> found = cell.detect(estimate, reach);
      for (std::size_t part = 0; part < setup.tool.size(); ++part) {
        double least = std::numeric_limits<double>::infinity();
        for (const CellContact& contact : found) {
          if (contact.body == RobotCell::kLinks + part) least = std::min(least, contact.distance);
        }
        const ClusteredOctree& tree = *setup.tool[part].tree;
        if (reach == 0.0) {
          const bool touches = collide(*setup.blisk, tree, believed).has_value();
          ASSERT_EQ(least <= 0.0, touches) << "pose " << i;
          ++asked;
          touching += touches;
          continue;
        }
        const double distance_between = distance(*setup.blisk, tree, believed).distance;
        ASSERT_EQ(least <= kReach, distance_between <= kReach) << "pose " << i;
        if (distance_between > 0.0 && distance_between <= kReach) {
          ++near;
          ASSERT_NEAR(least, distance_between, 1e-7);
        }
      }
    }
    ASSERT_EQ(cell.joints(), before);  // detection moves nothing
    ASSERT_LT(apart(cell.linkFrame(3), linkFrames(setup.arm, before)[3]), 1e-8);
  }
  EXPECT_GT(asked, 100);
  EXPECT_GT(touching, asked * 3 / 10);
  EXPECT_LT(touching, asked * 7 / 10);
  EXPECT_GT(near, 0);
}

TEST(RobotCell, detects_theArmsOwnLinks) {
  RobotCellSetup setup = smallSetup();
  const Pose wrist = linkFrames(setup.arm, readyJoints())[4];
  setup.blisk = treeOf(testing::torus(160.0, 65.0, 40, 24));
  setup.blisk_in_base.translation = wrist.translation + Vec3(0.0, 0.0, 30.0);
  RobotCell cell(setup);
  std::vector<ConvexHull> hulls;
  for (const LinkBody& body : linkBodies(setup.arm)) hulls.emplace_back(meshOf(body).vertices());
  std::mt19937_64 random(73);
  int asked = 0, touching = 0;
  for (int i = 0; i < 150; ++i) {
    Joints joints = readyJoints();
    for (double& joint : joints) joint += testing::uniform(random, -0.15, 0.15);
    const std::array<Pose, 6> frames = linkFrames(setup.arm, joints);
    const std::span<const CellContact> found = cell.detect(StateEstimate{joints, {}}, 0.0);
    for (std::size_t link = 0; link < 6; ++link) {
      const bool expected =
          collide(*setup.blisk, hulls[link], setup.blisk_in_base.inverse() * frames[link]).has_value();
      const bool says = std::ranges::any_of(found, [&](const CellContact& c) { return c.body == link; });
      ASSERT_EQ(says, expected) << joints.transpose() << ", link " << link;
      if (link < 3) continue;  // far away
      ++asked;
      touching += expected;
    }
  }
  EXPECT_GT(touching, asked * 3 / 10);
  EXPECT_LT(touching, asked * 7 / 10);
}

TEST(RobotCell, refusesWhatMakesNoCell) {
  RobotCellSetup setup = smallSetup();
  setup.tool.clear();
  EXPECT_THROW(RobotCell{setup}, std::invalid_argument);
  setup = smallSetup();
  setup.blisk = nullptr;
  EXPECT_THROW(RobotCell{setup}, std::invalid_argument);
  setup = smallSetup();
  setup.servo.torque[3] = -1.0;
  EXPECT_THROW(RobotCell{setup}, std::invalid_argument);
}

TEST(ArmBodies, massesOfABar_areThoseOfAPrism) {
  // A regular 16-gon's second moment about its axis, for radius 1 and mass 1.
  const double side = 2.0 * std::numbers::pi / 16.0;
  const double polar = (2.0 + std::cos(side)) / 6.0;
  const LinkBody body{{10.0, 20.0, 30.0}, {10.0, 20.0, 130.0}, 25.0, 4.0};
  const MassOfBody mass = massOf(meshOf(body), body.mass);
  EXPECT_TRUE(mass.center.isApprox(Vec3(10.0, 20.0, 80.0), 1e-12));
  EXPECT_NEAR(mass.inertia(2, 2), 4.0 * 625.0 * polar, 1e-9 * mass.inertia(2, 2));
  EXPECT_NEAR(mass.inertia(0, 0), 4.0 * (625.0 * polar / 2.0 + 1e4 / 12.0), 1e-9 * mass.inertia(0, 0));
}

TEST(ArmBodies, twoHalvesOfABar_areTheBar) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const Pose somewhere{turn, {5.0, -7.0, 9.0}};
  const auto bar = [](double from, double to, double mass) {
    return massOf(meshOf({{from, 0.0, 0.0}, {to, 0.0, 0.0}, 10.0, mass}), mass);
  };
  const MassOfBody halves[] = {somewhere * bar(0.0, 40.0, 1.0), somewhere * bar(40.0, 120.0, 2.0)};
  const MassOfBody whole = somewhere * bar(0.0, 120.0, 3.0), found = joined(halves);
  EXPECT_NEAR(found.mass, 3.0, 1e-12);
  EXPECT_TRUE(found.center.isApprox(whole.center, 1e-12));
  EXPECT_TRUE(found.inertia.isApprox(whole.inertia, 1e-10));
  EXPECT_THROW(joined({}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::demos
