// What the report says of Table 1.
#pragma once

#include "paper/claims.h"
#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Counts of nodes beside the paper's, then what they are to stand for: leaf volumes, false positives and
/// negatives; k_opt.
Section nodesSection(const SplitRun& run);

std::vector<Claim> nodesClaims(const SplitRun& run);

}  // namespace octoblisk::demos
