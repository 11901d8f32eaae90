// What a grinding run leaves behind: a table of contacts, a summary, pictures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/verdict.h"

namespace octoblisk::demos {

/// A finished run, as the reports need it.
struct GrindingRun {
  std::string blisk_name, belt_name, path_name;  ///< where they came from
  std::shared_ptr<const ClusteredOctree> blisk;
  std::vector<ToolPart> parts;
  int blade_count = 0;
  VerdictRules rules;
  double near_miss = 0.0;       ///< mm
  double seconds_a_pose = 0.0;  ///< mean
  std::vector<PoseReport> poses;

  std::size_t count(Verdict verdict) const;
};

/// poses.csv: for each pose its verdict, and part, blade and depth of its worst contact (empty where it has
/// no contact). Throws std::runtime_error naming a file that can't be written.
void writePoseVerdicts(const GrindingRun& run, const std::filesystem::path& file);

/// contacts.csv: a row for each contact of the reports, each with a verdict of its own. Points and normal are
/// in the blisk's frame; the normal points from the part into the blisk. Throws as above.
void writeContacts(const GrindingRun& run, const std::filesystem::path& file);

/// summary.json: limits (ground_blade: null where no blade was ground), counts, the ranges of poses that
/// interfere ("first" to "last", both included), the tree. Throws as above.
void writeSummary(const GrindingRun& run, const std::filesystem::path& file);

/// The pose to look at: the deepest contact that is not intended, else the deepest, else the middle of the
/// path.
std::size_t poseToShow(const GrindingRun& run);

/// The worst contact of a pose that has one: "belt on blade 2, 0.31 mm deep", "arm on hub or shroud, …".
std::string describeWorst(const GrindingRun& run, const PoseReport& pose);

/// overview.png: the blisk, the path and the tool at the pose to show. closeup.png: where it touches, with
/// the boxes of the tree. Throws as above.
void writePictures(const GrindingRun& run, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
