// The detection methods that are compared in the robot's control loop (Table 4).
#pragma once

#include <cstddef>

#include "octoblisk/types.h"
#include "paper/robot/robot_cell.h"
#include "paper/robot/robot_noise.h"
#include "paper/robot/robot_scene.h"
#include "paper/segmentation.h"

namespace octoblisk::demos {

/// The options of a run of the robot.
struct RobotRunOptions {
  double control_period = 0.004;  ///< s: that of ABB's Externally Guided Motion
  double speed = 20.0;            ///< of the contact wheel's centre along the path, mm/s; assumed
  double turn_rate = 0.5;         ///< greatest, rad/s; assumed
  int steps_per_tick = 4;         ///< of the Bullet world
  double margin = 0.2;            ///< mm: the second exact method reports everything within this distance
  int ground_blade = 1;           ///< the blade that the belt may touch
  detail::KMeansOptions k_means;  ///< for each part, in the paper's method
  std::size_t leaf_capacity = 2;  ///< in the paper's octrees (FNOP)
  NoiseOptions noise;
};

/// All of them check the measured pose.
enum class RobotMethod {
  traditional,  ///< the belt's one box against one octree over the blisk's points, by 15 separating axes
  improved,     ///< the paper's: the same against an octree for each cluster of each blade
  yes_or_no,    ///< exact, only on the triangles of belt and blisk, up to the first pair that meets
  exact,        ///< exact, all contacts of tool and arm, by Bullet with our shape and broadphase
  margin,       ///< the same, with a margin for the measuring errors
};
inline constexpr std::size_t kRobotMethods = 5;

/// In seconds: by the clock, and processor time of this thread.
struct TimeTaken {
  double clock = 0.0, processor = 0.0;
};

/// The answer of a method at a tick.
struct RobotAnswer {
  bool touch = false;      ///< the belt touches the blisk
  bool forbidden = false;  ///< there is a forbidden touch
  bool arm = false;        ///< a link of the arm touches the blisk
  TimeTaken taken;
};

/// Runs the methods one at a time.
class RobotMethods {
 public:
  /// All arguments must outlive it. Throws std::invalid_argument if the scene's clouds have no points.
  RobotMethods(const RobotScene& scene, const RobotRunOptions& options, RobotCell& cell);

  /// The volume of the boxes to examine, mm³.
  double range(RobotMethod method) const;

  RobotAnswer ask(RobotMethod method, const StateEstimate& estimate) const;

 private:
  RobotAnswer askBoxes(const Segmentation& boxes, const StateEstimate& estimate) const;
  RobotAnswer askTriangles(const StateEstimate& estimate) const;
  RobotAnswer askBullet(const StateEstimate& estimate, double reach) const;

  const RobotScene& scene_;
  const RobotRunOptions& options_;
  RobotCell& cell_;
  Obb belt_;  // in the belt's frame
  PaperOctrees octrees_;
};

}  // namespace octoblisk::demos
