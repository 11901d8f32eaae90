// Shows a grinding run as a replay.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grinding/coverage.h"
#include "grinding/grinding_run.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The verdicts of poses, numbered as in Verdict, then those of motions.
std::vector<ReplayVerdict> grindingVerdicts();

/// The poses of a run with at least one pose, with clearance and depth for chart 0; verdicts are
/// grindingVerdicts().
ReplayTrack grindingTrack(const GrindingRun& run, const std::string& name);

/// Clearance and depth over the path, with the run's limits.
ReplayChart clearanceChart(const GrindingRun& run);

/// Parts, limits and tolerances, files, tree, versions.
std::vector<Table> grindingFacts(const GrindingRun& run);

/// For a run with at least one pose. A coverage is part of the title, and its cells are drawn on the blade.
Replay grindingReplay(const GrindingRun& run, const std::optional<Coverage>& coverage = {});

}  // namespace octoblisk::demos
