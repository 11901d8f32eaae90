// What a grinding run leaves behind: tables and a summary. Its pictures: grinding_pictures.h.
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
  std::vector<DepthKind> depth_kinds;  ///< of each part
  int blade_count = 0;
  std::vector<int> blade_of_triangle;  ///< of the blisk's mesh
  VerdictRules rules;
  double near_miss = 0.0;               ///< mm
  double contact_seconds_a_pose = 0.0;  ///< mean: Bullet's answer which parts are near, and their contacts
  double depth_seconds_a_pose = 0.0;    ///< mean, of all threads together
  std::vector<PoseReport> poses;

  std::size_t count(Verdict verdict) const;
};

/// Poses first to last, counted from 0.
struct PoseRange {
  std::size_t first = 0, last = 0;
};

/// The runs of poses that interfere.
std::vector<PoseRange> interferingRanges(const GrindingRun& run);

/// poses.csv: for each pose its verdict, and part, blade and depth of its worst touch (empty where it has
/// no contact). The depth is that of the part as a solid. Throws std::runtime_error naming a file that can't
/// be written.
void writePoseVerdicts(const GrindingRun& run, const std::filesystem::path& file);

/// contacts.csv: a row for each contact of the reports, each with a verdict of its own. The depth is that of
/// the pair of triangles; the verdict goes by that of the part. Points and normal are
/// in the blisk's frame; the normal points from the part into the blisk. Throws as above.
void writeContacts(const GrindingRun& run, const std::filesystem::path& file);

/// summary.json: limits (ground_blade: null where no blade was ground), counts, the ranges of poses that
/// interfere ("first" to "last", both included), the tree. Throws as above.
void writeSummary(const GrindingRun& run, const std::filesystem::path& file);

}  // namespace octoblisk::demos
