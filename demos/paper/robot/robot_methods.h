// The methods of detection that are compared in the loop of the robot (Table 4).
#pragma once

#include <cstddef>
#include <set>

#include "octoblisk/types.h"
#include "paper/paper_octrees.h"
#include "paper/robot/robot_cell.h"
#include "paper/robot/robot_options.h"
#include "paper/robot/robot_scene.h"

namespace octoblisk::demos {

/// All are asked about the pose that is measured.
enum class RobotMethod {
  traditional,  ///< the belt's one box against one octree over the blisk's points, by 15 separating axes
  improved,     ///< the paper's: against an octree for each cluster of each blade
  yes_or_no,    ///< triangles, exactly, of belt and blisk alone, to the first two that meet
  exact,        ///< all contacts of tool and arm, exactly, by Bullet with our shape and broadphase
  margin,       ///< the same, with a margin for what the arm does not know
};
inline constexpr std::size_t kRobotMethods = 5;

/// In seconds: by the clock, and of this thread's processor time.
struct TimeTaken {
  double clock = 0.0, processor = 0.0;
};

/// What a method says at a tick.
struct RobotAnswer {
  bool touch = false;           ///< the belt touches the blisk
  bool forbidden = false;       ///< something touches that must not
  std::set<std::size_t> links;  ///< of the arm that touch the blisk
  TimeTaken taken;
};

/// Asks them one at a time.
class RobotMethods {
 public:
  /// All must outlive it. Throws std::invalid_argument where the scene's clouds have no points.
  RobotMethods(const RobotScene& scene, const RobotRunOptions& options, RobotCell& cell);

  /// Volume of the boxes that are to be examined, mm³.
  double range(RobotMethod method) const;

  RobotAnswer ask(RobotMethod method, const Belief& belief) const;

 private:
  RobotAnswer askBoxes(const Segmentation& boxes, const Belief& belief) const;
  RobotAnswer askTriangles(const Belief& belief) const;
  RobotAnswer askBullet(const Belief& belief, double reach) const;

  const RobotScene& scene_;
  const RobotRunOptions& options_;
  RobotCell& cell_;
  Obb belt_;  // in the belt's frame
  PaperOctrees octrees_;
};

}  // namespace octoblisk::demos
