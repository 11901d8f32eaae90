#include "paper/cmm/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace octoblisk::demos {

ErrorStatistics statisticsOf(std::span<const double> errors) {
  if (errors.size() < 2) throw std::invalid_argument("statistics need at least two errors");
  const auto [least, greatest] = std::minmax_element(errors.begin(), errors.end());
  const double count = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  double squares = 0.0;
  for (const double error : errors) squares += (error - mean) * (error - mean);
  return {*least, *greatest, mean, std::sqrt(squares / (count - 1.0))};
}

}  // namespace octoblisk::demos
