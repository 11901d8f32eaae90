// The numbers of the report's section on Table 5 and figures 13 and 14.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "paper/cmm/cmm_experiment.h"

namespace octoblisk::demos {

/// The pass planned with the options, a pass with an even feed, and passes with other parameters, each from a
/// run of the experiment. Throws std::invalid_argument as runCmmExperiment does.
nlohmann::json cmmNumbers(const TriangleMesh& blisk, const BladesFound& blades,
                          const CmmExperimentOptions& options = {});

}  // namespace octoblisk::demos
