// Sine, cosine and the angle of a quotient, of additions, products, quotients and square roots alone.
//
// Those of the C library differ in their last bits from processor to processor (with and without fused
// multiply-add), and what a sweep finds would differ with them.
#pragma once

namespace octoblisk::detail {

struct SineCosine {
  double sine = 0.0, cosine = 1.0;
};

/// Of an angle in radians; each is off by no more than 4e-16, of more than a million by some roundings
/// of the angle.
SineCosine sineCosine(double angle);

/// The angle in [0, π/2] whose tangent is y / x, for y, x >= 0, not both 0; off by no more than 6e-16.
double angleOf(double y, double x);

}  // namespace octoblisk::detail
