// The spread of a number over seeds or runs.
#pragma once

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "io/number_text.h"

namespace octoblisk::demos {

struct Spread {
  double least = 0.0, median = 0.0, mean = 0.0, most = 0.0;
};

/// Needs at least one value. The median of an even number of values is the mean of the two in the middle.
inline Spread spreadOf(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  const double upper = values[half], lower = values[(values.size() - 1) / 2];
  return {.least = values.front(),
          .median = 0.5 * (lower + upper),
          .mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()),
          .most = values.back()};
}

/// For ratios: "-3.4 % (-17.8 % to +8.5 %)", the mean, the least and the greatest.
inline std::string changeText(const Spread& ratios) {
  return changeText(1.0, ratios.mean) + " (" + changeText(1.0, ratios.least) + " to " +
         changeText(1.0, ratios.most) + ")";
}

/// For ratios: whether some values are below 1 and others above.
inline bool isSignOpen(const Spread& ratios) { return ratios.least < 1.0 && ratios.most > 1.0; }

}  // namespace octoblisk::demos
