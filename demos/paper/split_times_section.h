// What the report says of Table 2.
#pragma once

#include "paper/claims.h"
#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Split times beside the paper's.
Section splitTimesSection(const SplitRun& run);

std::vector<Claim> splitTimesClaims(const SplitRun& run);

}  // namespace octoblisk::demos
