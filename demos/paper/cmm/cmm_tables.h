// The tables of Table 5's section.
#pragma once

#include <string>
#include <vector>

#include "paper/cmm/cmm_experiment.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The planned pass and the even one beside the paper; what other parameters would have made of it, for which
/// the experiment is run again with each; the parameters.
/// Throws std::invalid_argument: what runCmmExperiment refuses.
std::vector<Table> cmmTables(const TriangleMesh& blisk, const BladesFound& blades,
                             const CmmExperimentOptions& options, const CmmExperiment& planned,
                             const CmmExperiment& even);

}  // namespace octoblisk::demos
