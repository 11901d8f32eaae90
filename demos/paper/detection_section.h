// The report's section on Table 3.
#pragma once

#include <string>
#include <vector>

#include "paper/claims.h"
#include "paper/detection_experiment.h"
#include "paper/detection_seeds.h"
#include "render/document.h"

namespace octoblisk::demos {

/// `lift` is the height of the lifted path off the blade, mm.
Section detectionSection(const DetectionResult& result, const DetectionSeeds& seeds,
                         const std::string& blisk_name, double lift);

std::vector<Claim> detectionClaims(const DetectionResult& result, const DetectionSeeds& seeds);

}  // namespace octoblisk::demos
