// What the report says of Table 3.
#pragma once

#include <string>
#include <vector>

#include "paper/claims.h"
#include "paper/detection_experiment.h"
#include "paper/detection_seeds.h"
#include "render/document.h"

namespace octoblisk::demos {

/// `lift` is how far off the blade the second path is held, mm.
Section detectionSection(const DetectionResult& result, const DetectionSeeds& seeds,
                         const std::string& blisk_name, double lift);

std::vector<Claim> detectionClaims(const DetectionResult& result, const DetectionSeeds& seeds);

}  // namespace octoblisk::demos
