// Writes the tables and the summary of a grinding run. Its pictures: grinding_pictures.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grinding/coverage.h"
#include "grinding/grinding_run.h"

namespace octoblisk::demos {

/// From the first to the last pose, counted from 0.
struct PoseRange {
  std::size_t first = 0, last = 0;
};

/// The runs of poses that interfere.
std::vector<PoseRange> interferingRanges(const GrindingRun& run);

/// poses.csv: for each pose its verdict; the part, blade, side, point, normal and depth of its worst touch
/// or, without one, of the nearest place; the clearance from forbidden surfaces; the outcome of the motion
/// from the previous pose (empty at the first); and the shape of the touched side and its channel. The depth
/// is that of the part as a solid; a clearance is a negative depth. Throws std::runtime_error naming a file
/// that cannot be written.
void writePoseVerdicts(const GrindingRun& run, const std::filesystem::path& file);

/// contacts.csv: one row per reported contact, each with its own verdict. The depth is that of the triangle
/// pair; the verdict depends on that of the part. Points and normal are in the blisk's frame; the normal
/// points from the part into the blisk. For a running belt, the row has its surface velocity at the contact
/// (belt_loop.h), without the tool's own motion; otherwise these columns are empty. Throws as above.
void writeContacts(const GrindingRun& run, const std::filesystem::path& file);

/// forces.csv: one row per pose with a load (spindle_cell.h). Throws as above.
void writeForces(const GrindingRun& run, const std::filesystem::path& file);

/// summary.json: limits (ground_blade: null if no blade was ground), counts, the ranges of poses that
/// interfere ("first" to "last", both included) and the tree; "partial" if not all poses were done. Throws as
/// above.
void writeSummary(const GrindingRun& run, const std::optional<Coverage>& coverage,
                  const std::filesystem::path& file);

/// The counts, the poses that interfere, the worst pose, and the findings between the poses. For a run of at
/// least one pose.
std::string summaryText(const GrindingRun& run);

/// The depth, between the poses, of parts in what they may touch: "proved within the limit on 380 of 393
/// motions; not proved on the others, but at most 0.4 mm". For a run whose motions were checked.
std::string depthOnMotions(const GrindingRun& run);

/// "clustered", "paper, k_opt, FNOP 8", "paper, k = 2, FNOP 20".
std::string partitionText(const BuildOptions& options);

}  // namespace octoblisk::demos
