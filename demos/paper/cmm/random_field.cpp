#include "paper/cmm/random_field.h"

#include <cmath>
#include <numbers>

namespace octoblisk::demos {

constexpr int kWaves = 96;

double RandomNumbers::uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1p-53; }

double RandomNumbers::normal() {
  const double distance = std::sqrt(-2.0 * std::log(uniform()));
  return distance * std::cos(2.0 * std::numbers::pi * uniform());
}

SmoothField::SmoothField(std::uint64_t seed, double curve_length, double correlation_along,
                         double correlation_up) {
  RandomNumbers random(seed);
  // The spectrum of a Gaussian correlation is Gaussian; only whole waves fit around a closed curve.
  const double round_deviation = curve_length / (2.0 * std::numbers::pi * correlation_along);
  for (int k = 0; k < kWaves; ++k) {
    const double round = 2.0 * std::numbers::pi * std::round(round_deviation * random.normal());
    const double up = random.normal() / correlation_up;
    waves_.push_back({round, up, 2.0 * std::numbers::pi * random.uniform()});
  }
}

double SmoothField::at(double part, double height) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::cos(wave.round * part + wave.up * height + wave.phase);
  return sum * std::sqrt(2.0 / kWaves);
}

}  // namespace octoblisk::demos
