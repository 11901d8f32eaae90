#include "paper/robot/robot_report.h"

#include <algorithm>
#include <utility>

#include "build/paper/principal_box.h"

namespace octoblisk::demos {

using namespace detail;

namespace {

constexpr std::size_t kRuns = 3;         // along the path, as in the paper
constexpr std::size_t kTicksToOne = 16;  // of the first run: one of these is used over the seeds

void add(RobotAlarms& sum, const RobotAlarms& alarms) {
  sum.alarms += alarms.alarms;
  sum.missed += alarms.missed;
  sum.false_alarms += alarms.false_alarms;
}

std::vector<Pose> someTicks(const RobotRun& run) {
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < run.ticks.size(); k += kTicksToOne) poses.push_back(run.ticks[k].tool_in_blisk);
  return poses;
}

}  // namespace

RobotReport runRobotExperiment(const RobotScene& scene, std::string blisk_name,
                               const std::vector<Pose>& lifted_path, double lift,
                               const RobotRunOptions& options,
                               const std::function<std::vector<Points>(std::uint64_t seed)>& parts_of_seed,
                               const Progress& progress) {
  RobotReport report;
  report.blisk_name = std::move(blisk_name);
  report.path_poses = scene.path.size();
  report.lift = lift;
  const CellLayout layout = chooseLayout(report.arm, scene.path, scene.blisk->mesh().bounds(), report.stand);
  const auto stretch = [&](std::size_t run) {
    constexpr double kShare = 0.8 / (kRuns + 1);
    return stretchOf(progress, kShare * static_cast<double>(run), kShare * static_cast<double>(run + 1));
  };
  RobotRunOptions of_run = options;
  for (std::size_t run = 0; run < kRuns; ++run) {
    of_run.noise.seed = options.noise.seed + run;
    report.runs.push_back(runRobot(scene, layout, of_run, report.arm, report.servo, stretch(run)));
  }
  RobotScene lifted = scene;
  lifted.path = lifted_path;
  of_run.noise.seed = options.noise.seed + kRuns;
  report.lifted = runRobot(lifted, layout, of_run, report.arm, report.servo, stretch(kRuns));
  const DetectionSeedOptions of_seeds{.fnop = options.leaf_capacity, .k_means = options.k_means};
  report.seeds = detectionOverSeeds(parts_of_seed, principalBox(scene.tool.front().tree->mesh().vertices()),
                                    someTicks(report.runs.front()), of_seeds, stretchOf(progress, 0.8, 1.0));
  return report;
}

RobotTotals totalsOf(std::span<const RobotRun> runs, RobotMethod method) {
  RobotTotals sum;
  for (const RobotRun& run : runs) {
    const RobotMethodResult& result = run.of(method);
    sum.ticks += run.ticks.size();
    sum.touching += run.touching_ticks;
    sum.forbidden += run.forbidden_ticks;
    sum.mean_seconds += result.mean_seconds / static_cast<double>(runs.size());
    sum.usual_seconds = std::max(sum.usual_seconds, result.usual_seconds);
    sum.worst_clock_seconds = std::max(sum.worst_clock_seconds, result.worst_clock_seconds);
    sum.worst_seconds = std::max(sum.worst_seconds, result.worst_seconds);
    sum.late += result.late_ticks;
    add(sum.touch, result.touch);
    if (result.forbidden) add(sum.wrong, *result.forbidden);
  }
  return sum;
}

}  // namespace octoblisk::demos
