// Tables 3 and 4 in the paper's form, with the paper's numbers beside ours.
#pragma once

#include <string>

#include "paper/published.h"
#include "render/document.h"

namespace octoblisk::demos {

/// Rows: the range, and the least, the median and the greatest time of the runs; our times have this number
/// of digits.
Table comparisonTable(std::string name, std::string caption, const DetectionTable& here,
                      const DetectionTable& paper, int digits_of_seconds);

/// A volume in the paper's unit, 10⁴ mm³.
std::string rangeText(double volume);

}  // namespace octoblisk::demos
