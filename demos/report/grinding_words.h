// A grinding run in a few lines.
#pragma once

#include <string>

#include "cell/grinding_run.h"

namespace octoblisk::demos {

/// What was found, for people: counts, the poses that interfere, the worst, what happens between the poses.
/// For a run of at least one pose.
std::string inWords(const GrindingRun& run);

}  // namespace octoblisk::demos
