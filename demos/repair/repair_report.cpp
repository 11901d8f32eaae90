#include "repair/repair_report.h"

#include <optional>
#include <sstream>

#include "access/access_summary.h"
#include "io/new_file.h"

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

}  // namespace octoblisk::demos
