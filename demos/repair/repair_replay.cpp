#include "repair/repair_replay.h"

#include <algorithm>

#include "report/grinding_replay.h"

namespace octoblisk::demos {
namespace {

std::string countOfPoses(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " pose" : " poses");
}

void addChanges(const PathRepair& repair, ReplayTrack& track) {
  constexpr std::size_t kChartOfChanges = 1;
  ReplaySeries tilt{.chart = kChartOfChanges, .name = "tilt", .unit = "°", .in_status = true};
  ReplaySeries slide{.chart = kChartOfChanges, .name = "slide", .unit = "mm", .in_status = true};
  ReplaySeries retract{.chart = kChartOfChanges, .name = "retraction", .unit = "mm", .in_status = true};
  for (const PoseRepair& pose : repair.poses) {
    tilt.values.push_back(pose.change.tilt);
    slide.values.push_back(pose.change.slide);
    retract.values.push_back(pose.change.retract);
  }
  for (ReplaySeries* const series : {&tilt, &slide, &retract}) track.series.push_back(std::move(*series));
}

std::string titleOf(const PathRepair& repair) {
  if (repair.isFree()) {
    const std::string lost = repair.contactsLost() == 0 ? std::string()
                                                        : "; " + countOfPoses(repair.contactsLost()) +
                                                              " lost contact with the blade";
    return (repair.interferedBefore() == 0
                ? "The path is free"
                : "Repaired: " + countOfPoses(repair.interferedBefore()) + " interfered, none does now") +
           lost;
  }
  const std::size_t motions = repair.motionsLeft();
  return "Left interfering: " + countOfPoses(repair.posesLeft()) +
         (motions == 0 ? std::string()
                       : " and " + std::to_string(motions) + (motions == 1 ? " motion" : " motions"));
}

}  // namespace

Replay repairReplay(const PathRepair& repair, const GrindingRun& before, const GrindingRun& after) {
  Replay replay = grindingReplay(after);
  replay.command = "repair";
  replay.title = titleOf(repair);
  replay.subtitle = countOfPoses(repair.changed()) + " of " + std::to_string(repair.poses.size()) +
                    " changed; select the original path beside the controls";
  replay.findings_title = "Remaining interference and near misses";
  replay.counts = {
      {"poses interfered", repair.interferedBefore(), Tone::near},
      {"poses changed", repair.changed(), Tone::clear},
      {"poses left interfering", repair.posesLeft(), Tone::interference},
      {"working poses that lost contact", repair.contactsLost(), Tone::interference},
      {"motions left between free poses", repair.motionsLeft(), Tone::interference},
  };
  replay.charts.push_back({.title = "Changes to the path", .unit = "degrees, mm"});
  ReplayTrack repaired = std::move(replay.tracks.front());
  repaired.name = "repaired";
  addChanges(repair, repaired);
  replay.tracks.clear();
  replay.tracks.push_back(std::move(repaired));
  replay.tracks.push_back(grindingTrack(before, "before"));
  const auto changed =
      std::ranges::find_if(repair.poses, [](const PoseRepair& pose) { return !pose.change.isNone(); });
  replay.start_at = changed == repair.poses.end() ? 0.0 : static_cast<double>(changed - repair.poses.begin());
  replay.notes.push_back(
      "Verdicts, clearances and contacts of both paths are those of octoblisk grind, which does not know "
      "about the repair. Tilt turns the tool about its wheels' axis, slide shifts it along that axis, and "
      "retraction lifts it off the surface.");
  return replay;
}

}  // namespace octoblisk::demos
