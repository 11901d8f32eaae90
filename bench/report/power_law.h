// Fits a power law, to show how fast something grows.
#pragma once

#include <span>

namespace octoblisk::bench {

/// y = factor · x^exponent.
struct PowerLaw {
  double factor = 1.0;
  double exponent = 0.0;
};

/// The least-squares fit of the logarithms. Throws std::invalid_argument if x has fewer than two different
/// values, if the numbers of x and y differ, or if a number is not above 0.
PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y);

}  // namespace octoblisk::bench
