// What Table 5 of the paper tells of a sample of errors.
#pragma once

#include <cstddef>
#include <span>

namespace octoblisk::demos {

/// mm. The paper does not say whether its deviation is that of a sample (n - 1) or of all (n); here n - 1.
struct ErrorStatistics {
  double min = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard
};

/// Of at least two values. Throws std::invalid_argument where there are fewer.
ErrorStatistics statisticsOf(std::span<const double> errors);

}  // namespace octoblisk::demos
