// An increasing map that gives a sample the requested statistics.
#pragma once

#include <span>
#include <vector>

namespace octoblisk::demos {

/// The statistics of a sample of errors that the paper's Table 5 gives, in mm. The paper does not say whether
/// its deviation is that of a sample (n - 1) or of all values (n); here n - 1.
struct ErrorStatistics {
  double min = 0.0;
  double max = 0.0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard
};

/// Throws std::invalid_argument for fewer than two values.
ErrorStatistics statisticsOf(std::span<const double> errors);

/// Maps values x of a field to errors so that a given sample of them gets exactly the given minimum, maximum,
/// mean and standard deviation:
///   u = the fraction of the sample below x, in [0, 1]; linear from value to value
///   v = u - s sin(2πu) / 2π      the spread s in [-1, 1] sets the deviation
///   w = v / (v + (1 - v) k)      the skew k > 0 sets the mean
///   error = min + (max - min) w
/// s and k are found by nested bisection. All steps are increasing and continuous. All but the first are
/// smooth; the kinks of the first become small for a large sample.
class StatisticsMap {
 public:
  /// Throws std::invalid_argument if the sample has fewer than two different values, or if no s and k give
  /// the statistics:
  /// the deviation must be about 0.21 to 0.38 of the range, the mean not far off centre.
  StatisticsMap(std::span<const double> sample, const ErrorStatistics& wanted);

  double operator()(double value) const;

 private:
  double partBelow(double value) const;

  std::vector<double> sample_;  ///< ascending, each once
  double spread_ = 0.0;
  double skew_ = 1.0;
  ErrorStatistics wanted_;
};

}  // namespace octoblisk::demos
