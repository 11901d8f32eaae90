// Hertz's contacts in closed form: a wheel on a flat, and two curved surfaces.
//
// Units: mm, N, MPa = N/mm². Equations: K. L. Johnson, Contact Mechanics (1985), chapter 4.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octoblisk::demos {

/// A cylinder of radius R on a flat, pressed by a force per length q: b² = 4qR / (πE*), p₀ = 2q / (πb).
struct LineContact {
  double half_width = 0.0;     ///< b, mm
  double peak_pressure = 0.0;  ///< p₀, MPa
};
inline LineContact lineContact(double force_per_length, double radius, double contact_modulus) {
  if (force_per_length <= 0.0) return {};
  const double half_width = std::sqrt(4.0 * force_per_length * radius / (std::numbers::pi * contact_modulus));
  return {half_width, 2.0 * force_per_length / (std::numbers::pi * half_width)};
}

/// Surfaces of relative principal radii R' and R'' (1/R = 1/R₁ + 1/R₂, > 0): an ellipse with a >= b,
///   p₀ = 3F / (2πab),  1/2R' = (p₀/E*) b/(e²a²) (K - E),  1/2R'' = (p₀/E*) b/(e²a²) (a²E/b² - K),
/// where K and E are the complete elliptic integrals of e = √(1 - b²/a²).
struct EllipticContact {
  double semi_major = 0.0;     ///< a, mm, along the direction of the greater radius
  double semi_minor = 0.0;     ///< b, mm
  double peak_pressure = 0.0;  ///< p₀, MPa
  double approach = 0.0;       ///< δ = (p₀/E*) b K, mm
};

/// K and (K - E) / K of the complete elliptic integrals, by the arithmetic-geometric mean; so the difference
/// loses no digits for small e.
struct EllipticIntegrals {
  double first;  ///< K
  double drop;   ///< (K - E) / K
};

inline EllipticIntegrals ellipticIntegrals(double minor_over_major) {
  double mean = 1.0;
  double geometric = minor_over_major;
  double drop = 0.5 * (1.0 - minor_over_major) * (1.0 + minor_over_major);
  for (double weight = 1.0; std::abs(mean - geometric) > 1e-15 * mean; weight *= 2.0) {
    const double half_difference = 0.5 * (mean - geometric);
    const double next = 0.5 * (mean + geometric);
    geometric = std::sqrt(mean * geometric);
    mean = next;
    drop += weight * half_difference * half_difference;
  }
  return {std::numbers::pi / (2.0 * mean), drop};
}

inline EllipticContact ellipticContact(double force, double radius_1, double radius_2,
                                       double contact_modulus) {
  if (force <= 0.0) return {};
  const auto [lesser, greater] = std::minmax({radius_1, radius_2});
  // R'/R'' falls as b/a grows to 1. The bisection is in the logarithm, because b/a may be small.
  double low = std::log(1e-8);
  double high = 0.0;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    const double ratio = std::exp(middle);
    const double e_squared = (1.0 - ratio) * (1.0 + ratio);
    const double drop = ellipticIntegrals(ratio).drop;
    const bool too_slender =
        e_squared > 0.0 && (e_squared - drop) / (ratio * ratio * drop) > greater / lesser;
    (too_slender ? low : high) = middle;
  }
  const double ratio = std::exp(0.5 * (low + high));
  const double e_squared = (1.0 - ratio) * (1.0 + ratio);
  const auto [first, drop] = ellipticIntegrals(ratio);
  // (a²E/b² - K) / e², which is π/4 for a circle
  const double bracket =
      e_squared > 1e-12 ? first * (e_squared - drop) / (ratio * ratio * e_squared) : 0.25 * std::numbers::pi;
  EllipticContact contact;
  contact.semi_major = std::cbrt(3.0 * force * lesser * bracket / (std::numbers::pi * contact_modulus));
  contact.semi_minor = ratio * contact.semi_major;
  contact.peak_pressure = 1.5 * force / (std::numbers::pi * contact.semi_major * contact.semi_minor);
  contact.approach = contact.peak_pressure / contact_modulus * contact.semi_minor * first;
  return contact;
}

}  // namespace octoblisk::demos
