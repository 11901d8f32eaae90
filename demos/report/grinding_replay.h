// A grinding run as a replay.
#pragma once

#include <string>
#include <vector>

#include "grinding/grinding_run.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The verdicts of poses, as Verdict numbers them, and of moves.
std::vector<ReplayVerdict> grindingVerdicts();

/// The poses of a run of at least one, with clearance and depth for chart 0; verdicts are grindingVerdicts().
ReplayTrack grindingTrack(const GrindingRun& run, const std::string& name);

/// Clearance and depth over the path, with the limits of the run.
ReplayChart clearanceChart(const GrindingRun& run);

/// Parts, limits and tolerances, files, tree, versions.
std::vector<Table> grindingFacts(const GrindingRun& run);

/// A run of at least one pose.
Replay grindingReplay(const GrindingRun& run);

}  // namespace octoblisk::demos
