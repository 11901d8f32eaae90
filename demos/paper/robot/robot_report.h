// The runs of the robot that Table 4 is made of.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "paper/detection_seeds.h"
#include "paper/robot/robot_experiment.h"

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
  DetectionSeeds seeds;  ///< of the paper's methods, at ticks of the first run
};

/// Chooses the layout for the scene's path and makes the runs, their seeds counted on from the options'. The
/// lifted path is to begin near the scene's; `parts_of_seed` gives the clouds of the blisk's parts. Throws as
/// chooseLayout and runRobot.
RobotReport runRobotExperiment(const RobotScene& scene, std::string blisk_name,
                               const std::vector<Pose>& lifted_path, double lift,
                               const RobotRunOptions& options,
                               const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                               const Progress& progress);

/// What a method did on several runs together.
struct RobotTotals {
  std::size_t ticks = 0, touching = 0, forbidden = 0;  ///< in truth
  double mean_seconds = 0.0, usual_seconds = 0.0;      ///< the mean of the runs, the greatest of them
  double worst_seconds = 0.0, worst_clock_seconds = 0.0;
  std::size_t late = 0;
  RobotAlarms touch, wrong;  ///< of touches, and of what must not touch
};
RobotTotals totalsOf(std::span<const RobotRun> runs, RobotMethod method);

}  // namespace octoblisk::demos
