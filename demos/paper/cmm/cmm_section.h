// The report's section on Table 5 and figures 13 and 14: a blade measured before and after grinding.
#pragma once

#include <filesystem>
#include <vector>

#include "paper/claims.h"
#include "paper/cmm/cmm_experiment.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The pass planned with the options, and a pass with an even feed.
struct CmmRuns {
  CmmExperimentOptions options;
  CmmExperiment planned, even;
};

/// Throws std::invalid_argument as runCmmExperiment does.
CmmRuns runCmm(const TriangleMesh& blisk, const BladesFound& blades,
               const CmmExperimentOptions& options = {});

/// Repeats the experiment with other parameters, and draws the figures into the folder. Throws as runCmm and
/// writeSvg.
Section cmmSection(const TriangleMesh& blisk, const BladesFound& blades, const CmmRuns& runs,
                   const std::filesystem::path& folder);

std::vector<Claim> cmmClaims(const CmmRuns& runs);

}  // namespace octoblisk::demos
