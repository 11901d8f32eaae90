// How fast something grows: the power law that fits best.
#pragma once

#include <span>

namespace octoblisk::bench {

/// y = factor · x^exponent.
struct PowerLaw {
  double factor = 1.0;
  double exponent = 0.0;
};

/// The law of least squares between the logarithms. Throws std::invalid_argument for fewer than two different
/// x, as many x as y not given, or a number that is not above 0.
PowerLaw fitPowerLaw(std::span<const double> x, std::span<const double> y);

}  // namespace octoblisk::bench
