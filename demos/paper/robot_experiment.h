// The paper's experiment on a robot (Table 4), run again in a Bullet world: an arm follows a grinding path,
// and at every tick of its control the belt is compared with the blisk by several methods.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cell/grinding_cell.h"
#include "models/blade_finder.h"
#include "paper/paper_model.h"
#include "paper/progress.h"
#include "robot/cell_layout.h"
#include "robot/robot_cell.h"

namespace octoblisk::demos {

/// What an arm's sensors get wrong. Each drawn from a normal distribution of the given standard deviation.
struct NoiseOptions {
  double encoder = 1e-5;  ///< of each joint at each tick, rad; assumed
  /// Of the tool's place and direction, along and about each axis, for a whole run (mm, rad): the
  /// unidirectional repeatability of an ABB IRB 1600 as M. Slamani, A. Nubiola and I. Bonev measured it
  /// (Industrial Robot 39 (1), 2012), taken as three standard deviations.
  double position = 0.037 / 3.0;
  double direction = 87e-6 / 3.0;
  std::uint64_t seed = 1;
};

struct RobotRunOptions {
  double control_period = 0.004;  ///< s: what ABB's Externally Guided Motion offers
  double speed = 20.0;            ///< of the contact wheel's centre along the path, mm/s; assumed
  double turn_rate = 0.5;         ///< at most, rad/s; assumed
  int steps_a_tick = 4;           ///< of the Bullet world
  double margin = 0.2;            ///< mm: the second exact method tells of everything as near as this
  int ground_blade = 1;           ///< that the belt may touch
  std::size_t clusters = 2;       ///< of each blade, in the paper's method (k)
  std::size_t leaf_capacity = 2;  ///< in the paper's octrees (FNOP)
  NoiseOptions noise;
};

/// The methods that are compared, all on the pose that is measured.
enum class RobotMethod {
  traditional,  ///< the belt's one box against one octree over the blisk's points, by 15 separating axes
  improved,     ///< the paper's: against an octree for each cluster of each blade
  yes_or_no,    ///< triangles, exactly, of belt and blisk alone, to the first two that meet
  exact,        ///< all contacts of tool and arm, exactly, by Bullet with our shape and broadphase
  margin,       ///< the same, with a margin for what the arm does not know
};
inline constexpr std::size_t kRobotMethods = 5;

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
  std::vector<RobotAlarms> forbidden;
};

struct RobotTick {
  double time = 0.0;                           ///< s
  double position_error = 0.0;                 ///< of the contact wheel's centre from where it is to be, mm
  double direction_error = 0.0;                ///< rad
  double sensing_error = 0.0;                  ///< of the centre as it is measured from where it is, mm
  std::array<float, kRobotMethods> seconds{};  ///< the processor's
  std::array<bool, kRobotMethods> alarm{};     ///< of the belt
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

/// What the cell is made of. The blades are those of the blisk's mesh; the belt is the tool's first part.
struct RobotScene {
  std::shared_ptr<const ClusteredOctree> blisk;
  BladesFound blades;
  std::vector<ToolPart> tool;
  std::vector<Points> clouds;  ///< of the blisk's parts, for the methods of the paper: see partClouds
  std::vector<Pose> path;      ///< the tool in the blisk's frame, mm
};

/// Follows the path in the given layout. What is true is found by exact queries on the triangles at the poses
/// as they are. Deterministic but for the times.
///
/// Throws std::invalid_argument for an option out of its range, for blades of another mesh, for clouds that
/// are missing or have fewer points than clusters, and as RobotCell and TimedPath do.
RobotRun runRobot(const RobotScene& scene, const CellLayout& layout, const RobotRunOptions& options = {},
                  const SixAxisArm& arm = {}, const ServoOptions& servo = {}, const Progress& progress = {});

}  // namespace octoblisk::demos
