#include "base/turn.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace octoblisk::detail {
namespace {

/// The arctangent, for t >= 0: that of t or of a quotient near 0, whose polynomial is by Sun Microsystems
/// (fdlibm, 1993).
float arctangent(float t) {
  struct Part {
    float above, angle, rest;  // the rest is what single precision omits of the angle
  };
  constexpr Part kParts[] = {{0.4375f, 0.0f, 0.0f},
                             {0.6875f, 0x1.dac67p-2f, 0x1.586ed2p-28f},
                             {1.1875f, 0x1.921fb4p-1f, 0x1.4442dp-25f},
                             {2.4375f, 0x1.f730bcp-1f, 0x1.281f68p-25f},
                             {std::numeric_limits<float>::infinity(), 0x1.921fb4p+0f, 0x1.4442dp-24f}};
  constexpr float k[] = {0x1.555556p-2f, -0x1.99999ap-3f, 0x1.24924ap-3f, -0x1.c71c7p-4f,
                         0x1.745cdcp-4f, -0x1.3b0f2ap-4f, 0x1.10d66ap-4f, -0x1.dde2d6p-5f,
                         0x1.97b4b2p-5f, -0x1.2b4442p-5f, 0x1.0ad3aep-6f};
  if (t >= 0x1p+25f) return 0x1.921fb6p+0f;
  const Part* part = kParts;
  while (t >= part->above) ++part;
  switch (part - kParts) {
    case 0:
      break;
    case 1:
      t = (2.0f * t - 1.0f) / (2.0f + t);
      break;
    case 2:
      t = (t - 1.0f) / (t + 1.0f);
      break;
    case 3:
      t = (t - 1.5f) / (1.0f + 1.5f * t);
      break;
    default:
      t = -1.0f / t;
  }
  const float z = t * t, w = z * z;
  const float even = z * (k[0] + w * (k[2] + w * (k[4] + w * (k[6] + w * (k[8] + w * k[10])))));
  const float odd = w * (k[1] + w * (k[3] + w * (k[5] + w * (k[7] + w * k[9]))));
  const float less = t * (even + odd);
  return part == kParts ? t - less : part->angle - ((less - part->rest) - t);
}

}  // namespace

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

SineCosineF sineCosine(float angle) {
  // Polynomials near 0 in double precision. The coefficients are those of ARM's optimized routines.
  const bool is_steep = angle >= std::numbers::pi_v<float> / 4.0f;
  const double rest = is_steep ? std::numbers::pi / 2.0 - angle : angle, square = rest * rest;
  const double fourth = square * square, third = rest * square;
  const double sine = (rest + third * -0x1.555545995a603p-3) +
                      third * square * (0x1.1107605230bc4p-7 + square * -0x1.994eb3774cf24p-13);
  const double cosine = ((1.0 + square * -0x1.ffffffd0c621cp-2) + fourth * 0x1.55553e1068f19p-5) +
                        fourth * square * (-0x1.6c087e89a359dp-10 + square * 0x1.99343027bf8c3p-16);
  const auto less = static_cast<float>(sine), more = static_cast<float>(cosine);
  return is_steep ? SineCosineF{more, less} : SineCosineF{less, more};
}

float angleOf(float y, float x) {
  constexpr float kPi = 0x1.921fb6p+1f, kRest = -0x1.777a5cp-24f;  // the rest is what kPi omits of π
  if (y == 0.0f) return x < 0.0f ? kPi : 0.0f;
  if (x == 0.0f) return kPi / 2.0f;
  const float angle = arctangent(y / std::abs(x));
  return x < 0.0f ? kPi - (angle - kRest) : angle;
}

}  // namespace octoblisk::detail
