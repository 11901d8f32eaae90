// Summarises a grinding run in a few lines.
#pragma once

#include <string>

#include "grinding/grinding_run.h"

namespace octoblisk::demos {

/// The counts, the poses that interfere, the worst pose, and the findings between the poses. For a run of at
/// least one pose.
std::string summaryText(const GrindingRun& run);

/// The depth, between the poses, of parts in what they may touch: "proved within the limit on 380 of 393
/// motions; not proved on the others, but at most 0.4 mm". For a run whose motions were checked.
std::string depthOnMotions(const GrindingRun& run);

/// "clustered", "paper, k_opt, FNOP 8", "paper, k = 2, FNOP 20".
std::string partitionText(const BuildOptions& options);

}  // namespace octoblisk::demos
