// Divides a length along a blade into steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "models/require.h"

namespace octoblisk::demos {

/// A running sum over equal or unequal steps, and the place where it reaches a fraction of its total.
class RunningSum {
 public:
  void add(double step) { sums_.push_back(sums_.back() + step); }
  double whole() const { return sums_.back(); }

  /// The place, in steps, at which the sum is this fraction of the total.
  double placeOf(double part) const {
    const double wanted = part * whole();
    const auto after = std::lower_bound(sums_.begin() + 1, sums_.end() - 1, wanted);
    const double before = *std::prev(after);
    const double step = *after - before;
    const double fraction = step > 0.0 ? std::clamp((wanted - before) / step, 0.0, 1.0) : 0.0;
    return static_cast<double>(std::prev(after) - sums_.begin()) + fraction;
  }

 private:
  std::vector<double> sums_ = {0.0};
};

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
