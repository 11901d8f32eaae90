// The pictures of a grinding run.
#pragma once

#include <cstddef>
#include <string>

#include "render/picture.h"
#include "report/grinding_report.h"

namespace octoblisk::demos {

/// The most interesting pose: that of the deepest unintended touch; without one, that of the deepest touch;
/// without any, the middle of the path.
std::size_t poseToShow(const GrindingRun& run);

/// The worst touch of a pose that has a touch: "belt on blade 2, 0.31 mm deep", "arm on hub or shroud, …",
/// "belt wholly inside the blisk, …".
std::string describeWorst(const GrindingRun& run, const PoseReport& pose);

/// The blisk with the ground blade, the path, and the tool at a pose.
Picture overviewOf(const GrindingRun& run, std::size_t pose);

/// The same at the pose to show.
Picture overviewOf(const GrindingRun& run);

/// The place where the tool touches, or comes nearest, at the pose to show, with the boxes of the blisk's
/// tree there.
Picture closeupOf(const GrindingRun& run);

}  // namespace octoblisk::demos
