#include "paper/cmm/statistics_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace octoblisk::demos {
namespace {

constexpr int kHalvings = 100;

double spreadOut(double u, double spread) {
  return u - spread * std::sin(2.0 * std::numbers::pi * u) / (2.0 * std::numbers::pi);
}

double skewed(double v, double skew) { return v / (v + (1.0 - v) * skew); }

/// Bisects an interval to the place where `tooLow` changes from true to false.
template <typename TooLow>
double bisect(double low, double high, const TooLow& tooLow) {
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (tooLow(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

ErrorStatistics statisticsOf(std::span<const double> errors) {
  if (errors.size() < 2) throw std::invalid_argument("statistics need at least two errors");
  const auto [least, greatest] = std::minmax_element(errors.begin(), errors.end());
  const double count = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  double squares = 0.0;
  for (const double error : errors) squares += (error - mean) * (error - mean);
  return {*least, *greatest, mean, std::sqrt(squares / (count - 1.0))};
}

StatisticsMap::StatisticsMap(std::span<const double> sample, const ErrorStatistics& wanted)
    : sample_(sample.begin(), sample.end()), wanted_(wanted) {
  std::sort(sample_.begin(), sample_.end());
  sample_.erase(std::unique(sample_.begin(), sample_.end()), sample_.end());
  if (sample_.size() < 2) throw std::invalid_argument("the sample has fewer than two different values");
  std::vector<double> uniform;
  for (const double value : sample) uniform.push_back(partBelow(value));

  const auto statistics = [&](double spread, double skew) {
    std::vector<double> errors;
    for (const double u : uniform) {
      errors.push_back(std::lerp(wanted.min, wanted.max, skewed(spreadOut(u, spread), skew)));
    }
    return statisticsOf(errors);
  };
  const auto skewFor = [&](double spread) {  // the greater the skew, the less the mean
    const double logarithm = bisect(-5.0, 5.0, [&](double log_skew) {
      return statistics(spread, std::exp(log_skew)).mean > wanted.mean;
    });
    return std::exp(logarithm);
  };
  spread_ = bisect(-1.0, 1.0, [&](double spread) {
    return statistics(spread, skewFor(spread)).deviation < wanted.deviation;
  });
  skew_ = skewFor(spread_);
  const ErrorStatistics reached = statistics(spread_, skew_);
  const double off =
      std::max(std::abs(reached.mean - wanted.mean), std::abs(reached.deviation - wanted.deviation));
  if (!(off <= 1e-9 * (wanted.max - wanted.min))) {
    throw std::invalid_argument("no stock has the requested minimum, maximum, mean and deviation");
  }
}

double StatisticsMap::partBelow(double value) const {
  if (value <= sample_.front()) return 0.0;
  if (value >= sample_.back()) return 1.0;
  const auto above = std::upper_bound(sample_.begin(), sample_.end(), value);
  const double part = (value - *(above - 1)) / (*above - *(above - 1));
  return (static_cast<double>(above - 1 - sample_.begin()) + part) / static_cast<double>(sample_.size() - 1);
}

double StatisticsMap::operator()(double value) const {
  return std::lerp(wanted_.min, wanted_.max, skewed(spreadOut(partBelow(value), spread_), skew_));
}

}  // namespace octoblisk::demos
