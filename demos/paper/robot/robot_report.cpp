#include "paper/robot/robot_report.h"

#include <algorithm>
#include <utility>

#include "paper/published.h"

namespace octoblisk::demos {
namespace {

void add(RobotAlarms& sum, const RobotAlarms& alarms) {
  sum.alarms += alarms.alarms;
  sum.missed += alarms.missed;
  sum.false_alarms += alarms.false_alarms;
}

}  // namespace

RobotReport runRobotExperiment(const RobotScene& scene, std::string blisk_name,
                               const std::vector<Pose>& lifted_path, double lift,
                               const RobotRunOptions& options, const Progress& progress) {
  RobotReport report;
  report.blisk_name = std::move(blisk_name);
  report.path_poses = scene.path.size();
  report.lift = lift;
  const CellLayout layout = chooseLayout(report.arm, scene.path, scene.blisk->mesh().bounds(), report.stand);
  const auto stretch = [&](std::size_t run) {
    constexpr double kShare = 1.0 / (kRuns + 1);
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
