// A way along a blade, cut into steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

#include "models/require.h"

namespace octoblisk::demos {

/// A growing sum over equal or unequal steps, and where it reaches a part of its whole.
class RunningSum {
 public:
  void add(double step) { sums_.push_back(sums_.back() + step); }
  double whole() const { return sums_.back(); }

  /// The place, in steps, at which the sum is this part of the whole.
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

/// How many equal steps of at most 1 a sum takes; at least one where it is above 0.
/// Throws std::invalid_argument beyond 1,000,000.
inline int stepsFor(double whole) {
  constexpr double kMostSteps = 1e6;
  constexpr double kRounding = 1e-9;
  require(whole <= kMostSteps, "the path would have more than 1,000,000 passes or poses a pass");
  return static_cast<int>(std::ceil(whole - kRounding));
}

/// Part k of count: 0 for the first, 1 for the last.
inline double evenPart(int k, int count) { return count > 1 ? static_cast<double>(k) / (count - 1) : 0.0; }

}  // namespace octoblisk::demos
