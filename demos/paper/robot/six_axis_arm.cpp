#include "paper/robot/six_axis_arm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace octoblisk::demos {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kInLine = 1e-9;  // sine below which two axes count as parallel; mm for the wrist on axis 1
constexpr double kRounding = 1e-12;

/// Moves each joint by whole turns to the value within its limits that is nearest to another. Returns false
/// if no value is within the limits.
bool turnWithinLimits(const SixAxisArm& arm, const Joints& near, Joints& joints) {
  for (Eigen::Index i = 0; i < joints.size(); ++i) {
    const double least = arm.least[i], greatest = arm.greatest[i];
    double turned = joints[i] + kTurn * std::round((near[i] - joints[i]) / kTurn);
    if (turned > greatest) turned -= kTurn * std::ceil((turned - greatest) / kTurn);
    if (turned < least) turned += kTurn * std::ceil((least - turned) / kTurn);
    if (turned > greatest + kRounding) return false;
    joints[i] = std::clamp(turned, least, greatest);
  }
  return true;
}

/// The two solutions of the wrist for an orientation of the flange, given the joints before it.
struct WristJoints {
  double joint4, joint5, joint6;
};

std::array<WristJoints, 2> wristFor(const Mat3& flange_in_forearm, double near_joint4) {
  // R = Rz(q4) Ry(−q5) Rz(q6): its last column is (−s5 c4, −s5 s4, c5).
  const Mat3& r = flange_in_forearm;
  const double sine5 = std::hypot(r(0, 2), r(1, 2));
  std::array<WristJoints, 2> found{};
  for (const int flip : {0, 1}) {
    const double sign = flip == 0 ? 1.0 : -1.0;
    const double joint5 = std::atan2(sign * sine5, r(2, 2));
    const double joint4 = sine5 < kInLine ? near_joint4 : std::atan2(-sign * r(1, 2), -sign * r(0, 2));
    const Mat3 before6 = Eigen::AngleAxisd(joint4, Vec3::UnitZ()).toRotationMatrix() *
                         Eigen::AngleAxisd(-joint5, Vec3::UnitY()).toRotationMatrix();
    const Mat3 turn6 = before6.transpose() * r;
    found[static_cast<std::size_t>(flip)] = {joint4, joint5, std::atan2(turn6(1, 0), turn6(0, 0))};
  }
  return found;
}

}  // namespace

Joints jointsOfDegrees(double joint1, double joint2, double joint3, double joint4, double joint5,
                       double joint6) {
  Joints degrees;
  degrees << joint1, joint2, joint3, joint4, joint5, joint6;
  return degrees * (std::numbers::pi / 180.0);
}

std::array<DhRow, 6> dhRows(const SixAxisArm& arm) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  return {{{0.0, arm.shoulder_height, arm.shoulder_offset, -kQuarter},
           {-kQuarter, 0.0, arm.upper_arm, 0.0},
           {0.0, 0.0, arm.elbow_offset, -kQuarter},
           {0.0, arm.forearm, 0.0, kQuarter},
           {0.0, 0.0, 0.0, -kQuarter},
           {0.0, arm.flange, 0.0, 0.0}}};
}

Pose dhStep(const DhRow& row, double joint) {
  const Mat3 about_z = Eigen::AngleAxisd(joint + row.offset, Vec3::UnitZ()).toRotationMatrix();
  const Mat3 about_x = Eigen::AngleAxisd(row.alpha, Vec3::UnitX()).toRotationMatrix();
  return {about_z * about_x, about_z * Vec3(row.a, 0.0, row.d)};
}

std::array<Pose, 6> linkFrames(const SixAxisArm& arm, const Joints& joints) {
  const std::array<DhRow, 6> rows = dhRows(arm);
  std::array<Pose, 6> frames;
  Pose frame;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    frame = frame * dhStep(rows[i], joints[static_cast<Eigen::Index>(i)]);
    frames[i] = frame;
  }
  return frames;
}

Pose flangeAt(const SixAxisArm& arm, const Joints& joints) { return linkFrames(arm, joints).back(); }

bool withinLimits(const SixAxisArm& arm, const Joints& joints) {
  return (joints.array() >= arm.least.array()).all() && (joints.array() <= arm.greatest.array()).all();
}

const char* nameOf(Reach reach) {
  switch (reach) {
    case Reach::reached:
      return "reached";
    case Reach::too_far:
      return "out of reach";
    default:
      return "beyond the joints' limits";
  }
}

Postures posturesFor(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& near) {
  Postures found;
  const Vec3 wrist = flange_in_base.translation - arm.flange * flange_in_base.rotation.col(2);
  const double from_axis1 = std::hypot(wrist.x(), wrist.y());
  const double front = from_axis1 < kInLine ? near[0] : std::atan2(wrist.y(), wrist.x());
  const double fore_link = std::hypot(arm.elbow_offset, arm.forearm);
  const double fore_angle = std::atan2(arm.forearm, arm.elbow_offset);

  for (const int turned : {0, 1}) {
    // The arm's plane: outwards from axis 2, and up.
    const double out = (turned == 0 ? from_axis1 : -from_axis1) - arm.shoulder_offset;
    const double up = wrist.z() - arm.shoulder_height;
    const double cosine = (out * out + up * up - arm.upper_arm * arm.upper_arm - fore_link * fore_link) /
                          (2.0 * arm.upper_arm * fore_link);
    if (std::abs(cosine) > 1.0 + kRounding) continue;
    const double bend = std::acos(std::clamp(cosine, -1.0, 1.0));
    for (const double elbow : {bend, -bend}) {
      Joints joints = Joints::Zero();
      joints[0] = turned == 0 ? front : front + std::numbers::pi;
      joints[1] = std::atan2(out, up) -
                  std::atan2(fore_link * std::sin(elbow), arm.upper_arm + fore_link * std::cos(elbow));
      joints[2] = elbow - fore_angle;
      const Mat3 forearm = linkFrames(arm, joints)[2].rotation;
      for (const WristJoints& wrist_joints :
           wristFor(forearm.transpose() * flange_in_base.rotation, near[3])) {
        joints.tail<3>() << wrist_joints.joint4, wrist_joints.joint5, wrist_joints.joint6;
        Joints within = joints;
        if (found.reach == Reach::too_far) found.reach = Reach::beyond_limits;
        if (!turnWithinLimits(arm, near, within)) continue;
        found.reach = Reach::reached;
        found.joints[static_cast<std::size_t>(found.count++)] = within;
      }
    }
  }
  return found;
}

Posture inverseKinematics(const SixAxisArm& arm, const Pose& flange_in_base, const Joints& last) {
  const Postures postures = posturesFor(arm, flange_in_base, last);
  Posture nearest{postures.reach};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < postures.count; ++i) {
    const Joints& joints = postures.joints[static_cast<std::size_t>(i)];
    const double squares = (joints - last).squaredNorm();
    if (squares >= least) continue;
    least = squares;
    nearest.joints = joints;
  }
  return nearest;
}

}  // namespace octoblisk::demos
