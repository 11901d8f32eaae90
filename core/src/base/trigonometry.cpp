#include "base/trigonometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octoblisk::detail {

SineCosine sineCosine(double angle) {
  // The angle minus a multiple of π/2, which is subtracted in parts (W. J. Cody, W. Waite, Software Manual
  // for the Elementary Functions, 1980). The first part has 33 bits, so that its multiples are exact.
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  const double quarters = std::round(angle * (2.0 * std::numbers::inv_pi));
  const double rest = ((angle - quarters * kFirst) - quarters * kSecond) - quarters * kThird;
  // Taylor series: within ±π/4, the omitted terms are below 1e-17.
  const double square = rest * rest;
  double sine = 0.0, cosine = 0.0;
  for (int n = 18; n > 0; n -= 2) {
    sine = (1.0 - sine) * (square / (n * (n + 1)));
    cosine = (1.0 - cosine) * (square / (n * (n - 1)));
  }
  sine = rest - rest * sine;
  cosine = 1.0 - cosine;
  switch (static_cast<int>(std::fmod(quarters, 4.0)) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

double angleOf(double y, double x) {
  // Halves the angle twice, tan(α/2) = t / (1 + √(1 + t²)), then uses the series of the arctangent.
  double t = std::min(x, y) / std::max(x, y);
  for (int i = 0; i < 2; ++i) t /= 1.0 + std::sqrt(1.0 + t * t);
  const double square = t * t;
  double sum = 0.0;
  for (int n = 25; n > 0; n -= 2) sum = 1.0 / n - square * sum;
  const double angle = 4.0 * t * sum;
  return y > x ? std::numbers::pi / 2.0 - angle : angle;
}

}  // namespace octoblisk::detail
