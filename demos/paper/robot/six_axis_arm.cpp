#include "paper/robot/six_axis_arm.h"

#include <numbers>

namespace octoblisk::demos {

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

}  // namespace octoblisk::demos
