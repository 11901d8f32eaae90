// Seeded random numbers, the same on every platform, and a smooth random field made from them.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace octoblisk::demos {

class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

  double uniform();  ///< in (0, 1)
  double normal();   ///< with mean 0 and standard deviation 1, by Box and Muller's method

 private:
  std::mt19937_64 engine_;
};

/// A random field over a closed curve and the direction up from it: a sum of waves, and so smooth to any
/// order, with a mean near 0 and a variance near 1. Over a distance d in either direction, values correlate
/// by about exp(-d²/2c²).
class SmoothField {
 public:
  /// The curve's length, and the correlation lengths c along it and up (mm, > 0).
  SmoothField(std::uint64_t seed, double curve_length, double correlation_along, double correlation_up);

  /// At a fraction 0..1 of the curve and a height (mm). The fractions 0 and 1 are the same place.
  double at(double part, double height) const;

 private:
  struct Wave {
    double round;  ///< whole waves around the curve, as an angle
    double up;     ///< angle per mm
    double phase;
  };
  std::vector<Wave> waves_;
};

}  // namespace octoblisk::demos
