// Divides a length along a blade into steps.
#pragma once

#include <cmath>

#include "models/require.h"

namespace octoblisk::demos {

/// The number of equal steps of at most 1 in a sum; at least one if it is above 0. Throws
/// std::invalid_argument beyond 1,000,000.
inline int stepsFor(double whole) {
  constexpr double kMaxSteps = 1e6;
  constexpr double kRounding = 1e-9;
  require(whole <= kMaxSteps, "the path would have more than 1,000,000 passes, or poses per pass");
  return static_cast<int>(std::ceil(whole - kRounding));
}

/// Step k of count as a fraction: 0 for the first, 1 for the last.
inline double evenPart(int k, int count) { return count > 1 ? static_cast<double>(k) / (count - 1) : 0.0; }

}  // namespace octoblisk::demos
