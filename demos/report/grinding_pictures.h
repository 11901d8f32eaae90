// The pictures of a grinding run.
#pragma once

#include <cstddef>
#include <string>

#include "render/picture.h"
#include "report/grinding_report.h"

namespace octoblisk::demos {

/// The pose to look at: the deepest touch that is not intended, else the deepest, else the middle of the
/// path.
std::size_t poseToShow(const GrindingRun& run);

/// The worst touch of a pose that has one: "belt on blade 2, 0.31 mm deep", "arm on hub or shroud, …",
/// "belt wholly inside the blisk, …".
std::string describeWorst(const GrindingRun& run, const PoseReport& pose);

/// The blisk with the ground blade, the path, and the tool at a pose.
Picture overviewOf(const GrindingRun& run, std::size_t pose);

/// The same at the pose to show.
Picture overviewOf(const GrindingRun& run);

/// Where the tool touches at the pose to show, or comes nearest, with the boxes of the blisk's tree there.
Picture closeupOf(const GrindingRun& run);

}  // namespace octoblisk::demos
