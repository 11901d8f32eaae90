// What a grinding run leaves behind: tables and a summary. Its pictures: grinding_pictures.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "grinding/coverage.h"
#include "grinding/grinding_run.h"

namespace octoblisk::demos {

/// Poses first to last, counted from 0.
struct PoseRange {
  std::size_t first = 0, last = 0;
};

/// The runs of poses that interfere.
std::vector<PoseRange> interferingRanges(const GrindingRun& run);

/// poses.csv: for each pose its verdict, and part, blade, side, point, normal and depth of its worst touch,
/// or else of where it comes nearest; how far it is from what it must not touch; and what happens on the way
/// from the pose before (empty at the first); the side's shape and the channel of that touch. The depth is
/// that of the part as a solid; a clearance is a negative depth. Throws std::runtime_error naming a file that
/// can't be written.
void writePoseVerdicts(const GrindingRun& run, const std::filesystem::path& file);

/// contacts.csv: a row for each contact of the reports, each with a verdict of its own. The depth is that of
/// the pair of triangles; the verdict goes by that of the part. Points and normal are
/// in the blisk's frame; the normal points from the part into the blisk. Of a part that runs, its surface
/// velocity there (belt_loop.h), without the tool's own motion; else empty. Throws as above.
void writeContacts(const GrindingRun& run, const std::filesystem::path& file);

/// forces.csv: a row for each pose that has a load (spindle_cell.h). Throws as above.
void writeForces(const GrindingRun& run, const std::filesystem::path& file);

/// summary.json: limits (ground_blade: null where no blade was ground), counts, the ranges of poses that
/// interfere ("first" to "last", both included), the tree; "partial" where not all poses were done. Throws as
/// above.
void writeSummary(const GrindingRun& run, const std::optional<Coverage>& coverage,
                  const std::filesystem::path& file);

}  // namespace octoblisk::demos
