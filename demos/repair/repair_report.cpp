#include "repair/repair_report.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "access/access_summary.h"
#include "io/new_file.h"
#include "io/number_text.h"
#include "report/grinding_replay.h"

namespace octoblisk::demos {
namespace {

std::string stateText(const PoseState& state) {
  if (state.obstacle) return "interference";
  return state.grinds ? "grinds" : "free";
}

std::string obstacleText(const std::optional<Obstruction>& obstacle, std::span<const ToolPart> parts,
                         const BodyNames& names) {
  return obstacle ? describe(*obstacle, parts, names) : std::string();
}

/// For a working pose; otherwise empty.
const char* contactText(const PathRepair& repair, std::size_t pose) {
  if (!repair.poses[pose].works) return "";
  if (repair.hasLostContact(pose)) return "lost";
  return repair.poses[pose].after.grinds ? "kept" : "";
}

/// Adds the runs of equal texts; empty texts are skipped.
void addRuns(const std::vector<std::string>& texts, const std::string& one, const std::string& many,
             std::vector<std::string>& runs) {
  for (std::size_t first = 0; first < texts.size();) {
    std::size_t last = first;
    while (last + 1 < texts.size() && texts[last + 1] == texts[first]) ++last;
    if (!texts[first].empty()) {
      const std::string range = first == last
                                    ? one + ' ' + std::to_string(first)
                                    : many + ' ' + std::to_string(first) + '-' + std::to_string(last);
      runs.push_back(range + ": " + texts[first]);
    }
    first = last + 1;
  }
}

}  // namespace

void writeChanges(const PathRepair& repair, std::span<const ToolPart> parts, const BodyNames& names,
                  const std::filesystem::path& file) {
  std::ostringstream stream;
  stream.precision(9);
  stream << "pose,before,obstacle_before,tilt_deg,slide_mm,retract_mm,after,obstacle_after,obstacle_on_"
            "motion,contact\n";
  for (std::size_t p = 0; p < repair.poses.size(); ++p) {
    const PoseRepair& pose = repair.poses[p];
    stream << p << ',' << stateText(pose.before) << ',' << obstacleText(pose.before.obstacle, parts, names)
           << ',' << pose.change.tilt << ',' << pose.change.slide << ',' << pose.change.retract << ','
           << stateText(pose.after) << ',' << obstacleText(pose.after.obstacle, parts, names) << ','
           << obstacleText(pose.motion, parts, names) << ',' << contactText(repair, p) << '\n';
  }
  writeFile(file, stream.str());
}

std::vector<std::string> describeLeft(const PathRepair& repair, std::span<const ToolPart> parts,
                                      const BodyNames& names) {
  std::vector<std::string> of_poses, of_motions, runs;
  for (const PoseRepair& pose : repair.poses) {
    of_poses.push_back(obstacleText(pose.after.obstacle, parts, names));
    of_motions.push_back(obstacleText(pose.motion, parts, names));
  }
  addRuns(of_poses, "pose", "poses", runs);
  addRuns(of_motions, "motion to pose", "motions to poses", runs);
  return runs;
}

std::string describeLost(const PathRepair& repair) {
  std::string text;
  for (std::size_t first = 0; first < repair.poses.size(); ++first) {
    if (!repair.hasLostContact(first)) continue;
    std::size_t last = first;
    while (last + 1 < repair.poses.size() && repair.hasLostContact(last + 1)) ++last;
    text += (text.empty() ? "" : ", ") +
            (first == last ? "pose " + std::to_string(first)
                           : "poses " + std::to_string(first) + '-' + std::to_string(last));
    first = last;
  }
  return text;
}

namespace {

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
    const std::string lost =
        repair.contactsLost() == 0
            ? std::string()
            : "; " + countedText(repair.contactsLost(), "pose", "poses") + " lost contact with the blade";
    return (repair.interferedBefore() == 0
                ? "The path is free"
                : "Repaired: " + countedText(repair.interferedBefore(), "pose", "poses") +
                      " interfered, none does now") +
           lost;
  }
  const std::size_t motions = repair.motionsLeft();
  return "Left interfering: " + countedText(repair.posesLeft(), "pose", "poses") +
         (motions == 0 ? std::string()
                       : " and " + std::to_string(motions) + (motions == 1 ? " motion" : " motions"));
}

}  // namespace

Replay repairReplay(const PathRepair& repair, const GrindingRun& before, const GrindingRun& after) {
  Replay replay = grindingReplay(after);
  replay.command = "repair";
  replay.title = titleOf(repair);
  replay.subtitle = countedText(repair.changed(), "pose", "poses") + " of " +
                    std::to_string(repair.poses.size()) +
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
