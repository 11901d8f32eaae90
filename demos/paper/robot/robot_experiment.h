// Reruns the paper's robot experiment (Table 4) in a Bullet world: an arm follows a grinding path, and at
// every tick of its control several methods compare the belt with the blisk.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "paper/progress.h"
#include "paper/robot/cell_layout.h"
#include "paper/robot/robot_cell.h"
#include "paper/robot/robot_methods.h"
#include "paper/robot/robot_scene.h"

namespace octoblisk::demos {

/// The numbers of a method's alarms and errors.
struct RobotAlarms {
  std::size_t alarms = 0;
  std::size_t missed = 0;        ///< ticks with a touch and without an alarm
  std::size_t false_alarms = 0;  ///< ticks with an alarm and without a touch
  void count(bool alarm, bool truth);
};

struct RobotMethodResult {
  double range = 0.0;                              ///< volume of the boxes to examine, mm³
  double mean_seconds = 0.0, worst_seconds = 0.0;  ///< per tick, processor time
  double usual_seconds = 0.0;                      ///< that 99.9 % of the ticks do not exceed
  double worst_clock_seconds = 0.0;                ///< including other work of the machine
  std::size_t late_ticks = 0;                      ///< that took longer than the control period by the clock
  RobotAlarms touch;                               ///< the belt touches the blisk

  /// A forbidden touch: the belt on another blade or the hub, or another part on anything. None for methods
  /// that test only whether the belt touches, not where.
  std::optional<RobotAlarms> forbidden;
};

struct RobotTick {
  double time = 0.0;                           ///< s
  double position_error = 0.0;                 ///< of the contact wheel's centre from its target, mm
  double direction_error = 0.0;                ///< rad
  double sensing_error = 0.0;                  ///< of the measured centre from the true one, mm
  std::array<float, kRobotMethods> seconds{};  ///< processor time
  std::array<bool, kRobotMethods> alarm{};     ///< for a touch of the belt
  Pose tool_in_blisk;                          ///< as measured
  bool touch = false;                          ///< the belt truly touches the blisk
  bool forbidden = false;                      ///< there truly is a forbidden touch
};

/// Collisions of the arm's own bodies with the blisk.
struct ArmCollisions {
  std::size_t ticks = 0;       ///< ticks at which Bullet finds one at the measured joints
  std::size_t true_ticks = 0;  ///< by exact queries at the true joints
};

struct RobotRun {
  RobotRunOptions options;
  CellLayout layout;
  double duration = 0.0;  ///< of the path, s
  Joints joints_halfway = Joints::Zero();
  std::vector<RobotTick> ticks;
  std::array<RobotMethodResult, kRobotMethods> methods;
  double mean_position_error = 0.0, worst_position_error = 0.0;  ///< mm
  double worst_direction_error = 0.0;                            ///< rad
  double mean_sensing_error = 0.0, worst_sensing_error = 0.0;    ///< mm
  std::size_t touching_ticks = 0, forbidden_ticks = 0;           ///< true numbers
  std::size_t unreached_ticks = 0;      ///< at which the arm waits, because the pose is out of reach
  double least_margin_to_limits = 0.0;  ///< of the true joints, rad
  ArmCollisions arm;
  const RobotMethodResult& of(RobotMethod method) const { return methods[static_cast<std::size_t>(method)]; }
};

/// Follows the path in the given layout. Exact queries on the triangles at the true poses give the truth.
/// Deterministic except for the times.
///
/// Throws std::invalid_argument for an option out of range, for blades of another mesh, for missing or empty
/// clouds, and as RobotCell and TimedPath do.
RobotRun runRobot(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options = {},
                  const SixAxisArm& arm = {}, const ServoOptions& servo = {}, const Progress& progress = {});

}  // namespace octoblisk::demos
