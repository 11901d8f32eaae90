// Sine, cosine and arctangent of a quotient, from additions, products, quotients and square roots only.
//
// The C library's functions differ in their last bits between systems and processors (with and without fused
// multiply-add), and trees and the results of sweeps would differ with them.
#pragma once

namespace octoblisk::detail {

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};

/// Sine and cosine of an angle in radians. The error is at most 4e-16; for angles above a million, also some
/// rounding errors of the angle.
SineCosine sineCosine(double angle);

/// The angle in [0, π/2] whose tangent is y / x, for y, x >= 0, not both 0. The error is at most 6e-16.
double angleOf(double y, double x);

}  // namespace octoblisk::detail
