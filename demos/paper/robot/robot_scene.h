// The content of the robot's cell (Table 4).
#pragma once

#include <memory>
#include <vector>

#include "grinding/grinding_cell.h"
#include "models/blade_finder.h"
#include "paper/paper_model.h"

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

}  // namespace octoblisk::demos
