// A grinding run in a few lines.
#pragma once

#include <string>

#include "grinding/grinding_run.h"

namespace octoblisk::demos {

/// What was found, for people: counts, the poses that interfere, the worst, what happens between the poses.
/// For a run of at least one pose.
std::string inWords(const GrindingRun& run);

/// How deep what may touch is between the poses: "proved within the limit on 380 of 393 moves; on the others
/// not measured, but no more than 0.4 mm". For a run whose moves were checked.
std::string depthOnMoves(const GrindingRun& run);

/// "clustered", "paper, k_opt, FNOP 8", "paper, k = 2, FNOP 20".
std::string partitionText(const BuildOptions& options);

}  // namespace octoblisk::demos
