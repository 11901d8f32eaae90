// A smooth increasing map that gives a sample the statistics asked for.
#pragma once

#include <span>

#include "cmm/error_statistics.h"

namespace octoblisk::demos {

/// Maps values x of a field, roughly normal, to errors so that a given sample of them gets exactly a given
/// least, greatest and mean value and standard deviation:
///   u = (Φ(x) - Φ(x_min)) / (Φ(x_max) - Φ(x_min)), clamped to [0, 1]; Φ the normal distribution's
///   v = u - s sin(2πu) / 2π      the spread s in [-1, 1] sets the deviation
///   w = v / (v + (1 - v) k)      the skew k > 0 sets the mean
///   error = min + (max - min) w
/// s and k are found by nested bisection. Each step is increasing and, within the sample's range, smooth.
class StatisticsMap {
 public:
  /// Throws std::invalid_argument where the sample has fewer than two different values, or where no s and k
  /// give the statistics: the deviation must be about 0.2 to 0.37 of the range, the mean not far off centre.
  StatisticsMap(std::span<const double> sample, const ErrorStatistics& wanted);

  double operator()(double value) const;

 private:
  double least_;     ///< Φ of the sample's least value
  double greatest_;  ///< and of its greatest
  double spread_ = 0.0;
  double skew_ = 1.0;
  ErrorStatistics wanted_;
};

}  // namespace octoblisk::demos
