#include "paper/robot/cell_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace octoblisk::demos {
namespace {

constexpr double kLeap = 0.5 * std::numbers::pi;

/// How far along a path the arm gets with one branch.
struct Followed {
  std::size_t reached = 0;  ///< poses
  Reach why = Reach::reached;
  double margin = std::numeric_limits<double>::infinity();
};

double marginOf(const SixAxisArm& arm, const Joints& joints) {
  const double of_limits = std::min((joints - arm.least).minCoeff(), (arm.greatest - joints).minCoeff());
  return std::min(of_limits, std::abs(joints[4]));
}

Followed follow(const SixAxisArm& arm, const CellLayout& layout, const std::vector<Pose>& tool_in_blisk) {
  const Pose flange_in_tool = layout.tool_in_flange.inverse();
  Followed followed;
  Joints last = layout.start;
  for (const Pose& pose : tool_in_blisk) {
    const Posture next = inverseKinematics(arm, layout.blisk_in_base * pose * flange_in_tool, last);
    followed.why = next.reach;
    if (next.reach == Reach::reached && (next.joints - last).cwiseAbs().maxCoeff() > kLeap) {
      followed.why = Reach::beyond_limits;
    }
    if (followed.why != Reach::reached) return followed;
    last = next.joints;
    followed.margin = std::min(followed.margin, marginOf(arm, last));
    ++followed.reached;
  }
  return followed;
}

}  // namespace

Pose toolInFlange(double tool_length) {
  Pose tool_in_flange;
  tool_in_flange.rotation.col(0) = -Vec3::UnitZ();
  tool_in_flange.rotation.col(1) = -Vec3::UnitX();
  tool_in_flange.rotation.col(2) = Vec3::UnitY();
  tool_in_flange.translation = tool_length * Vec3::UnitZ();
  return tool_in_flange;
}

Pose bliskInBase(const StandOptions& stand, double turntable_angle, double middle) {
  const Mat3 axis_along_y = Eigen::AngleAxisd(-0.5 * std::numbers::pi, Vec3::UnitX()).toRotationMatrix();
  const Mat3 turned = Eigen::AngleAxisd(turntable_angle, Vec3::UnitZ()).toRotationMatrix();
  Pose blisk_in_base{axis_along_y * turned, stand.center};
  blisk_in_base.translation -= blisk_in_base.rotation * Vec3(0.0, 0.0, middle);
  return blisk_in_base;
}

CellLayout chooseLayout(const SixAxisArm& arm, const std::vector<Pose>& tool_in_blisk, const Aabb& bounds,
                        const StandOptions& stand) {
  if (tool_in_blisk.empty()) throw std::invalid_argument("the path for the cell's layout has no poses");
  if (stand.turntable_steps < 1) throw std::invalid_argument("the turntable needs at least one angle to try");

  CellLayout best;
  best.margin = -1.0;
  Followed farthest;
  farthest.why = Reach::too_far;
  for (int step = 0; step < stand.turntable_steps; ++step) {
    CellLayout layout;
    layout.turntable_angle = 2.0 * std::numbers::pi * step / stand.turntable_steps;
    layout.blisk_in_base = bliskInBase(stand, layout.turntable_angle, bounds.center().z());
    layout.tool_in_flange = toolInFlange(stand.tool_length);
    const Pose first = layout.blisk_in_base * tool_in_blisk.front() * layout.tool_in_flange.inverse();
    const Postures starts = posturesFor(arm, first, Joints::Zero());
    if (starts.count == 0 && farthest.reached == 0) farthest.why = starts.reach;
    for (int start = 0; start < starts.count; ++start) {
      layout.start = starts.joints[static_cast<std::size_t>(start)];
      const Followed followed = follow(arm, layout, tool_in_blisk);
      if (followed.reached > farthest.reached) farthest = followed;
      if (followed.reached < tool_in_blisk.size() || followed.margin <= best.margin) continue;
      best = layout;
      best.margin = followed.margin;
    }
  }
  if (best.margin < 0.0) {
    throw std::invalid_argument(
        "the arm cannot follow the path at any angle of the turntable: at best it reaches all poses before "
        "pose " +
        std::to_string(farthest.reached) + " (counted from 0), which is " + nameOf(farthest.why));
  }
  return best;
}

}  // namespace octoblisk::demos
