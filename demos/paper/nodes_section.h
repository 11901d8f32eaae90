// The report's section on Table 1.
#pragma once

#include "paper/claims.h"
#include "paper/split_run.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The numbers of nodes beside the paper's, then the measures that they are meant to stand for: leaf volumes,
/// false positives and negatives; then k_opt.
Section nodesSection(const SplitRun& run);

std::vector<Claim> nodesClaims(const SplitRun& run);

}  // namespace octoblisk::demos
