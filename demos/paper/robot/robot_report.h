// The robot's runs for Table 4.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "paper/detection_seeds.h"
#include "paper/robot/robot_experiment.h"

namespace octoblisk::demos {

/// The experiment: three runs along the path, as in the paper, with different noise, and one along the same
/// path lifted off the blade, where every touch is interference.
struct RobotReport {
  std::size_t path_poses = 0;
  SixAxisArm arm;
  ServoOptions servo;
  StandOptions stand;
  std::vector<RobotRun> runs;
  RobotRun lifted;
  DetectionSeeds seeds;  ///< of the paper's methods, at ticks of the first run
};

/// Chooses the layout for the scene's path and makes the runs, with seeds counted up from that of the
/// options. The lifted path must begin near the scene's path; `parts_of_seed` gives the clouds of the blisk's
/// parts. Throws as chooseLayout and runRobot.
RobotReport runRobotExperiment(const RobotScene& scene, const std::vector<Pose>& lifted_path,
                               const RobotRunOptions& options,
                               const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                               const Progress& progress);

/// The results of a method over several runs.
struct RobotTotals {
  std::size_t ticks = 0, touching = 0, forbidden = 0;  ///< true numbers
  double mean_seconds = 0.0, usual_seconds = 0.0;      ///< mean over the runs; greatest of the runs
  double worst_seconds = 0.0, worst_clock_seconds = 0.0;
  std::size_t late = 0;
  RobotAlarms touch, wrong;  ///< for touches, and for forbidden touches
};
RobotTotals totalsOf(std::span<const RobotRun> runs, RobotMethod method);

void to_json(nlohmann::json& json, const RobotReport& report);

/// Draws the cell halfway along the first run. Throws as writePng.
void drawRobotCell(const RobotReport& report, const RobotScene& scene, const std::filesystem::path& file);

}  // namespace octoblisk::demos
