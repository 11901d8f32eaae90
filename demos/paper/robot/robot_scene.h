// The content of the robot's cell (Table 4), and the true touches in it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "grinding/grinding_cell.h"
#include "models/blade_finder.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "paper/paper_model.h"
#include "paper/robot/six_axis_arm.h"

namespace octoblisk::demos {

/// The blades are those of the blisk's mesh; the belt is the tool's first part.
struct RobotScene {
  std::shared_ptr<const ClusteredOctree> blisk;
  BladesFound blades;
  std::vector<ToolPart> tool;
  std::vector<Points> clouds;  ///< of the blisk's parts, for the paper's methods: see partClouds
  std::vector<Pose> path;      ///< the tool in the blisk's frame, mm
};

/// The blisk with the built-in belt grinder. `clouds` are those of its parts: see partClouds.
RobotScene robotScene(const PaperModel& blisk, std::vector<Points> clouds, std::vector<Pose> path);

/// The true touches: exact queries on the triangles at a pose, without a world or a broadphase.
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
