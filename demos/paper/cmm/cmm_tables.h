// The tables of Table 5's section.
#pragma once

#include <vector>

#include "paper/cmm/cmm_experiment.h"
#include "render/document.h"

namespace octoblisk::demos {

/// The planned pass and the even one beside the paper; the results with other parameters, each from a new run
/// of the experiment; the parameters. Throws std::invalid_argument as runCmmExperiment does.
std::vector<Table> cmmTables(const TriangleMesh& blisk, const BladesFound& blades,
                             const CmmExperimentOptions& options, const CmmExperiment& planned,
                             const CmmExperiment& even);

}  // namespace octoblisk::demos
