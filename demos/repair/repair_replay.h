// A repaired path beside the one it was made from, as a replay.
#pragma once

#include "grinding/grinding_run.h"
#include "repair/path_repair.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// The two runs are of the path before and after, as octoblisk grind judges them, with as many poses as the
/// repair.
Replay repairReplay(const PathRepair& repair, const GrindingRun& before, const GrindingRun& after);

}  // namespace octoblisk::demos
