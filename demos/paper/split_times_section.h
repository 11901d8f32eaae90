// The report's section on Table 2.
#pragma once

#include "paper/claims.h"
#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Compares the split times with the paper's.
Section splitTimesSection(const SplitRun& run);

std::vector<Claim> splitTimesClaims(const SplitRun& run);

}  // namespace octoblisk::demos
