// The true touches: exact queries on the triangles at a pose, without a world or a broadphase.
#pragma once

#include <array>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "paper/robot/robot_scene.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

struct Touches {
  bool belt = false;  ///< the tool's first part touches the blisk
  /// It touches another blade than the ground one, or the hub; or another part touches.
  bool forbidden = false;
};

class TrueTouch {
 public:
  /// The scene must outlive it.
  TrueTouch(const RobotScene& scene, int ground_blade, const SixAxisArm& arm);

  Touches of(const Pose& tool_in_blisk);

  /// Whether a link of the arm touches the blisk.
  bool ofArm(const std::array<Pose, 6>& links_in_blisk) const;

 private:
  const RobotScene& scene_;
  int ground_blade_;
  std::vector<ConvexHull> links_;
  std::vector<TrianglePair> pairs_;
};

}  // namespace octoblisk::demos
