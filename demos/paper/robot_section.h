// What the report says of Table 4: the experiment on a robot.
#pragma once

#include <string>
#include <vector>

#include "paper/robot_experiment.h"
#include "report/document.h"

namespace octoblisk::demos {

/// The experiment: three runs along the path, as in the paper, that differ by their noise, and one along the
/// same path held off the blade, where every touch is interference.
struct RobotReport {
  std::string blisk_name;
  std::size_t path_poses = 0;
  double lift = 0.0;  ///< of the second path, mm
  SixAxisArm arm;
  ServoOptions servo;
  StandOptions stand;
  std::vector<RobotRun> runs;
  RobotRun lifted;
};

/// The blisk with the built-in belt grinder. `clouds`: of its parts, see partClouds.
RobotScene robotScene(const PaperModel& blisk, std::vector<Points> clouds, std::vector<Pose> path);

/// Chooses the layout for the scene's path and makes the runs, their seeds counted on from the options'. The
/// lifted path is to begin near the scene's. Throws as chooseLayout and runRobot.
RobotReport runRobotExperiment(const RobotScene& scene, std::string blisk_name,
                               const std::vector<Pose>& lifted_path, double lift,
                               const RobotRunOptions& options, const Progress& progress);

/// Tables and words; no figures.
Section robotSection(const RobotReport& report);

}  // namespace octoblisk::demos
