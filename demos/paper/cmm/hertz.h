// Hertz's contact of elastic solids: a wheel on a flat, and two curved surfaces.
//
// Units: mm, N, MPa = N/mm². Equations: K. L. Johnson, Contact Mechanics (1985), chapter 4. They hold for
// contacts that are small compared with the radii and the elastic cover; a soft wheel is at the limit of
// this.
#pragma once

namespace octoblisk::demos {

struct ElasticSolid {
  double youngs_modulus = 0.0;  ///< MPa
  double poissons_ratio = 0.0;
};

/// E* of two solids: 1/E* = (1-ν₁²)/E₁ + (1-ν₂²)/E₂ (MPa).
double contactModulus(const ElasticSolid& a, const ElasticSolid& b);

/// The modulus of rubber (MPa) with a Shore A hardness S in (0, 100), after A. N. Gent (1958), "On the
/// relation between indentation hardness and Young's modulus": 0.0981 (56 + 7.62336 S) / (0.137505 (254
/// - 2.54 S)).
double rubberModulus(double shore_a);

/// A cylinder of radius R on a flat, pressed by a force per length q: b² = 4qR / (πE*), p₀ = 2q / (πb).
struct LineContact {
  double half_width = 0.0;     ///< b, mm
  double peak_pressure = 0.0;  ///< p₀, MPa
};
LineContact lineContact(double force_per_length, double radius, double contact_modulus);

/// Surfaces of relative principal radii R' and R'' (1/R = 1/R₁ + 1/R₂, > 0): an ellipse with a >= b,
///   p₀ = 3F / (2πab),  1/2R' = (p₀/E*) b/(e²a²) (K - E),  1/2R'' = (p₀/E*) b/(e²a²) (a²E/b² - K),
/// where K and E are the complete elliptic integrals of e = √(1 - b²/a²).
struct EllipticContact {
  double semi_major = 0.0;     ///< a, mm, along the direction of the greater radius
  double semi_minor = 0.0;     ///< b, mm
  double peak_pressure = 0.0;  ///< p₀, MPa
  double approach = 0.0;       ///< δ = (p₀/E*) b K, mm
};
EllipticContact ellipticContact(double force, double radius_1, double radius_2, double contact_modulus);

}  // namespace octoblisk::demos
