// The paper's experiment on a robot (Table 4), run again in a Bullet world: an arm follows a grinding path,
// and at every tick of its control the belt is compared with the blisk by several methods.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "paper/progress.h"
#include "paper/robot/cell_layout.h"
#include "paper/robot/robot_cell.h"
#include "paper/robot/robot_methods.h"
#include "paper/robot/robot_options.h"
#include "paper/robot/robot_scene.h"

namespace octoblisk::demos {

/// How often a method spoke up, and how often wrongly.
struct RobotAlarms {
  std::size_t alarms = 0;
  std::size_t missed = 0;        ///< ticks at which there was something and it kept silent
  std::size_t false_alarms = 0;  ///< ticks at which there was nothing
  void count(bool alarm, bool truth);
};

struct RobotMethodResult {
  double range = 0.0;                              ///< volume of the boxes that are to be examined, mm³
  double mean_seconds = 0.0, worst_seconds = 0.0;  ///< of a tick, in the processor's time
  double usual_seconds = 0.0;                      ///< that 99.9 % of the ticks do not exceed
  double worst_clock_seconds = 0.0;                ///< what other work took from this thread included
  std::size_t late_ticks = 0;                      ///< that took longer than the control period, by the clock
  RobotAlarms touch;                               ///< the belt touches the blisk
  /// Something touches that must not: the belt another blade or the hub, another part anything. None of
  /// methods that ask of the belt alone, and not where.
  std::optional<RobotAlarms> forbidden;
};

struct RobotTick {
  double time = 0.0;                           ///< s
  double position_error = 0.0;                 ///< of the contact wheel's centre from where it is to be, mm
  double direction_error = 0.0;                ///< rad
  double sensing_error = 0.0;                  ///< of the centre as it is measured from where it is, mm
  std::array<float, kRobotMethods> seconds{};  ///< the processor's
  std::array<bool, kRobotMethods> alarm{};     ///< of the belt
  Pose tool_in_blisk;                          ///< as measured
  bool touch = false;                          ///< the belt truly touches the blisk
  bool forbidden = false;                      ///< something truly touches that must not
};

/// The arm's own bodies against the blisk.
struct ArmCollisions {
  std::size_t ticks = 0;           ///< at which Bullet finds one, at the measured joints
  std::size_t true_ticks = 0;      ///< by exact queries at the joints as they are
  std::vector<std::string> links;  ///< that were found
};

struct RobotRun {
  RobotRunOptions options;
  CellLayout layout;
  double duration = 0.0;  ///< of the path, s
  Joints joints_half_way = Joints::Zero();
  std::vector<RobotTick> ticks;
  std::array<RobotMethodResult, kRobotMethods> methods;
  double mean_position_error = 0.0, worst_position_error = 0.0;  ///< mm
  double worst_direction_error = 0.0;                            ///< rad
  double mean_sensing_error = 0.0, worst_sensing_error = 0.0;    ///< mm
  std::size_t touching_ticks = 0, forbidden_ticks = 0;           ///< in truth
  std::size_t unreached_ticks = 0;      ///< at which the arm waits where it is, as the pose is out of reach
  double least_margin_to_limits = 0.0;  ///< of the joints as they were, rad
  ArmCollisions arm;
  const RobotMethodResult& of(RobotMethod method) const { return methods[static_cast<std::size_t>(method)]; }
};

/// Follows the path in the given layout. What is true is found by exact queries on the triangles at the poses
/// as they are. Deterministic but for the times.
///
/// Throws std::invalid_argument for an option out of its range, for blades of another mesh, for clouds that
/// are missing or empty, and as RobotCell and TimedPath do.
RobotRun runRobot(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options = {},
                  const SixAxisArm& arm = {}, const ServoOptions& servo = {}, const Progress& progress = {});

}  // namespace octoblisk::demos
