// The statistics of a sample of errors that the paper's Table 5 gives.
#pragma once

#include <span>

namespace octoblisk::demos {

/// In mm. The paper does not say whether its deviation is that of a sample (n - 1) or of all values (n); here
/// n - 1.
struct ErrorStatistics {
  double min = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard
};

/// Throws std::invalid_argument for fewer than two values.
ErrorStatistics statisticsOf(std::span<const double> errors);

}  // namespace octoblisk::demos
