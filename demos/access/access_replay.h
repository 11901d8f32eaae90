// An accessibility map as a replay: the tool at each point, at the middle of its widest free range.
#pragma once

#include <memory>
#include <string>

#include "access/access_report.h"
#include "models/blade_finder.h"
#include "report/replay.h"

namespace octoblisk::demos {

/// Of a map of at least one point; `blisk_name` as it is to be told.
Replay accessReplay(const AccessRun& run, std::shared_ptr<const ClusteredOctree> blisk,
                    const BladesFound& blades, const std::string& blisk_name);

}  // namespace octoblisk::demos
