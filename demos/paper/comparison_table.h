// Tables 3 and 4 in the paper's form, with the paper's numbers beside ours.
#pragma once

#include <string>
#include <vector>

#include "paper/claims.h"
#include "paper/published.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Rows: the range, the time of each run, and their average; times here with so many digits.
Table comparisonTable(std::string name, std::string caption, const DetectionTable& here,
                      const DetectionTable& paper, int digits_of_seconds);

/// The change of the range, and of the average time.
std::vector<Claim> comparisonClaims(const std::string& table, const DetectionTable& here,
                                    const DetectionTable& paper);

/// A volume in the paper's unit, 10⁴ mm³.
std::string rangeText(double volume);

}  // namespace octoblisk::demos
