// Shows a repaired path beside its original, as a replay.
#pragma once

#include "grinding/grinding_run.h"
#include "repair/path_repair.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The two runs are those of octoblisk grind for the original and the repaired path; both have one pose per
/// pose of the repair.
Replay repairReplay(const PathRepair& repair, const GrindingRun& before, const GrindingRun& after);

}  // namespace octoblisk::demos
