// The pictures of a grinding run.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "report/grinding_report.h"
#include "report/picture.h"

namespace octoblisk::demos {

/// The pose to look at: the deepest touch that is not intended, else the deepest, else the middle of the
/// path.
std::size_t poseToShow(const GrindingRun& run);

/// The worst touch of a pose that has one: "belt on blade 2, 0.31 mm deep", "arm on hub or shroud, …",
/// "belt wholly inside the blisk, …".
std::string describeWorst(const GrindingRun& run, const PoseReport& pose);

/// The blisk with the ground blade, the path, and the tool at the pose to show.
Picture overviewOf(const GrindingRun& run);

/// The same with the tool at any pose of the run, seen from the same place.
Picture overviewAt(const GrindingRun& run, std::size_t shown);

/// Where the tool touches at the pose to show, or comes nearest, with the boxes of the blisk's tree there.
Picture closeupOf(const GrindingRun& run);

/// Writes overview.png and closeup.png. Throws std::runtime_error naming a file that can't be written.
void writePictures(const GrindingRun& run, const std::filesystem::path& folder);

}  // namespace octoblisk::demos
