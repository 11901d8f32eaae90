// What the report says of Table 5 and figures 13 and 14: a blade measured before and after grinding.
#pragma once

#include <filesystem>

#include "cmm/cmm_experiment.h"
#include "report/document.h"

namespace octoblisk::demos {

/// Runs the experiment as its options say, once more with an even feed, and with other parameters, and draws
/// the figures into the folder.
/// Throws std::invalid_argument: what runCmmExperiment refuses; and as writeSvg.
Section cmmSection(const TriangleMesh& blisk, const BladesFound& blades, const std::filesystem::path& folder,
                   const CmmExperimentOptions& options = {});

}  // namespace octoblisk::demos
