// The frames of the arm's links, and the joints that bring the flange to a pose.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "demos/robot_poses.h"
#include "paper/robot/six_axis_arm.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

constexpr double kPi = std::numbers::pi;
using Mat4 = Eigen::Matrix4d;

/// One joint's matrix, element by element as in textbooks.
Mat4 dhMatrix(double theta, double d, double a, double alpha) {
  const double ct = std::cos(theta), st = std::sin(theta), ca = std::cos(alpha), sa = std::sin(alpha);
  Mat4 matrix;
  matrix << ct, -st * ca, st * sa, a * ct,  //
      st, ct * ca, -ct * sa, a * st,        //
      0.0, sa, ca, d,                       //
      0.0, 0.0, 0.0, 1.0;
  return matrix;
}

/// The default arm's frames as products of these matrices, with its dimensions written out again.
std::array<Mat4, 6> framesByMatrices(const Joints& q) {
  const Mat4 steps[] = {dhMatrix(q[0], 500.0, 175.0, -kPi / 2.0), dhMatrix(q[1] - kPi / 2.0, 0.0, 900.0, 0.0),
                        dhMatrix(q[2], 0.0, 175.0, -kPi / 2.0),   dhMatrix(q[3], 960.0, 0.0, kPi / 2.0),
                        dhMatrix(q[4], 0.0, 0.0, -kPi / 2.0),     dhMatrix(q[5], 135.0, 0.0, 0.0)};
  std::array<Mat4, 6> frames;
  Mat4 frame = Mat4::Identity();
  for (std::size_t i = 0; i < 6; ++i) frames[i] = frame = frame * steps[i];
  return frames;
}

Joints randomJoints(std::mt19937_64& random, const SixAxisArm& arm) {
  Joints joints;
  for (Eigen::Index i = 0; i < 6; ++i) joints[i] = testing::uniform(random, arm.least[i], arm.greatest[i]);
  return joints;
}

/// The distance of two poses: mm, and the greatest difference of the rotations' elements, in mm at 1 m.
/// Only joints away from parallel axes and a straight elbow, so that poses determine joints.
bool isRegular(const SixAxisArm& arm, const Joints& joints) {
  const Vec3 wrist = linkFrames(arm, joints)[3].translation;
  const double elbow = joints[2] + std::atan2(arm.forearm, arm.elbow_offset);
  return std::abs(std::sin(joints[4])) > 1e-2 && std::abs(std::sin(elbow)) > 1e-2 &&
         std::hypot(wrist.x(), wrist.y()) > 1.0;
}

TEST(SixAxisArm, frames_equal_productsOfMatrices) {
  const SixAxisArm arm;
  std::mt19937_64 random(61);
  for (int i = 0; i < 200; ++i) {
    const Joints joints = randomJoints(random, arm);
    const std::array<Pose, 6> found = linkFrames(arm, joints);
    const std::array<Mat4, 6> expected = framesByMatrices(joints);
    for (std::size_t link = 0; link < 6; ++link) {
      const Pose pose{expected[link].topLeftCorner<3, 3>(), expected[link].topRightCorner<3, 1>()};
      ASSERT_LT(apart(found[link], pose), 1e-9) << "joints " << joints.transpose() << ", link " << link;
    }
  }
}

TEST(SixAxisArm, atZero_isUprightAndPointsToTheFront) {
  const Pose flange = flangeAt({}, Joints::Zero());
  EXPECT_TRUE(flange.translation.isApprox(Vec3(175.0 + 960.0 + 135.0, 0.0, 500.0 + 900.0 + 175.0), 1e-12));
  EXPECT_TRUE(flange.rotation.col(2).isApprox(Vec3::UnitX(), 1e-12));
}

TEST(SixAxisArm, joint2_leansForward) {
  Joints joints = Joints::Zero();
  joints[1] = kPi / 2.0;
  EXPECT_TRUE(linkFrames({}, joints)[1].translation.isApprox(Vec3(175.0 + 900.0, 0.0, 500.0), 1e-12));
}

TEST(InverseKinematics, everyPosture_reachesThePose_withinLimits_andOneIsTheJoints) {
  const SixAxisArm arm;
  std::mt19937_64 random(62);
  int tried = 0, several = 0;
  for (int i = 0; i < 2000; ++i) {
    const Joints joints = randomJoints(random, arm);
    if (!isRegular(arm, joints)) continue;
    ++tried;
    const Pose flange = flangeAt(arm, joints);
    const Postures postures = posturesFor(arm, flange, joints);
    ASSERT_EQ(postures.reach, Reach::reached);
    double nearest = 1.0;
    for (int p = 0; p < postures.count; ++p) {
      const Joints& found = postures.joints[static_cast<std::size_t>(p)];
      ASSERT_TRUE(withinLimits(arm, found)) << found.transpose();
      ASSERT_LT(apart(flangeAt(arm, found), flange), 1e-6) << found.transpose();
      nearest = std::min(nearest, (found - joints).cwiseAbs().maxCoeff());
    }
    ASSERT_LT(nearest, 1e-8) << joints.transpose();
    several += postures.count > 1;

    const Posture chosen = inverseKinematics(arm, flange, joints);
    ASSERT_EQ(chosen.reach, Reach::reached);
    ASSERT_LT((chosen.joints - joints).cwiseAbs().maxCoeff(), 1e-8);
  }
  EXPECT_GT(tried, 1800);
  EXPECT_GT(several, tried / 2);
}

TEST(InverseKinematics, withoutLimits_finds8DifferentPostures) {
  SixAxisArm arm;
  arm.least.setConstant(-kPi);
  arm.greatest.setConstant(kPi);
  std::mt19937_64 random(63);
  int of_all_branches = 0, tried = 0;
  for (int i = 0; i < 500; ++i) {
    const Joints joints = randomJoints(random, arm);
    if (!isRegular(arm, joints)) continue;
    ++tried;
    const Postures postures = posturesFor(arm, flangeAt(arm, joints), Joints::Zero());
    ASSERT_GE(postures.count, 4);  // with the arm facing away, the wrist may be out of reach
    ASSERT_EQ(postures.count % 4, 0);
    of_all_branches += postures.count == 8;
    for (int a = 0; a < postures.count; ++a) {
      ASSERT_LT(apart(flangeAt(arm, postures.joints[static_cast<std::size_t>(a)]), flangeAt(arm, joints)),
                1e-6);
      for (int b = 0; b < a; ++b) {
        const Joints difference =
            postures.joints[static_cast<std::size_t>(a)] - postures.joints[static_cast<std::size_t>(b)];
        double greatest = 0.0;
        for (const double each : difference) greatest = std::max(greatest, std::abs(std::sin(0.5 * each)));
        ASSERT_GT(greatest, 1e-4);
      }
    }
  }
  EXPECT_GT(of_all_branches, tried / 2);
}

TEST(InverseKinematics, takesTheBranchNearestToTheLastJoints) {
  const SixAxisArm arm;
  std::mt19937_64 random(64);
  for (int i = 0; i < 300; ++i) {
    const Joints joints = randomJoints(random, arm), last = randomJoints(random, arm);
    const Pose flange = flangeAt(arm, joints);
    const Posture chosen = inverseKinematics(arm, flange, last);
    ASSERT_EQ(chosen.reach, Reach::reached);
    const Postures postures = posturesFor(arm, flange, last);
    for (int p = 0; p < postures.count; ++p) {
      ASSERT_LE((chosen.joints - last).norm(),
                (postures.joints[static_cast<std::size_t>(p)] - last).norm() + 1e-12);
    }
  }
}

TEST(InverseKinematics, joint6_keepsItsTurn) {
  const SixAxisArm arm;
  const Joints joints = jointsOfDegrees(10.0, 20.0, -15.0, 30.0, 40.0, 350.0);
  const Pose flange = flangeAt(arm, joints);
  Joints last = joints;
  EXPECT_NEAR(inverseKinematics(arm, flange, last).joints[5], joints[5], 1e-9);
  last[5] -= 2.0 * kPi;
  EXPECT_NEAR(inverseKinematics(arm, flange, last).joints[5], joints[5] - 2.0 * kPi, 1e-9);
}

TEST(InverseKinematics, whereAxes4And6AreInLine_joint4StaysAsItWas) {
  const SixAxisArm arm;
  const Joints joints = jointsOfDegrees(10.0, 20.0, -15.0, 30.0, 0.0, 40.0);
  Joints last = joints;
  last[3] += 0.2;
  const Posture found = inverseKinematics(arm, flangeAt(arm, joints), last);
  EXPECT_NEAR(found.joints[3], last[3], 1e-12);
  EXPECT_NEAR(found.joints[5], joints[5] - 0.2, 1e-7);
  EXPECT_LT(apart(flangeAt(arm, found.joints), flangeAt(arm, joints)), 1e-5);
}

TEST(InverseKinematics, saysWhyAPoseIsNotReached) {
  SixAxisArm arm;
  Pose flange;
  flange.translation = {5000.0, 0.0, 500.0};
  EXPECT_EQ(inverseKinematics(arm, flange, Joints::Zero()).reach, Reach::too_far);

  SixAxisArm without_offset;  // otherwise it would reach back over itself
  without_offset.shoulder_offset = 0.0;
  flange.translation = {10.0, 0.0, without_offset.shoulder_height + without_offset.flange};
  EXPECT_EQ(inverseKinematics(without_offset, flange, Joints::Zero()).reach, Reach::too_far);  // too near

  const Joints joints = jointsOfDegrees(90.0, 20.0, -15.0, 30.0, 40.0, 50.0);
  flange = flangeAt(arm, joints);
  EXPECT_EQ(inverseKinematics(arm, flange, joints).reach, Reach::reached);
  arm.least[0] = -0.1;
  arm.greatest[0] = 0.1;
  EXPECT_EQ(inverseKinematics(arm, flange, joints).reach, Reach::beyond_limits);
  EXPECT_STREQ(nameOf(Reach::beyond_limits), "beyond the joints' limits");
}

}  // namespace
}  // namespace octoblisk::demos
