// The sum of steps along a line.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

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

}  // namespace octoblisk::demos
