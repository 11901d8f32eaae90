// Numbers in double-double precision: the unevaluated sum of two doubles (T. J. Dekker, A Floating-Point
// Technique for Extending the Available Precision, 1971). Needs -ffp-contract=off.
#pragma once

#include <cmath>

namespace octoblisk::detail {

struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  /// a − b, exactly.
  static DoubleDouble difference(double a, double b) {
    const double high = a - b, part = high - a;
    return {high, (a - (high - part)) - (b + part)};
  }
  double rounded() const { return high + low; }
};

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const double sum = a.high + b.high, part = sum - a.high;
  const double tail = (a.high - (sum - part)) + (b.high - part) + a.low + b.low;
  const double high = sum + tail;
  return {high, tail - (high - sum)};
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + DoubleDouble{-b.high, -b.low};
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const double product = a.high * b.high;
  const double tail = std::fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
  const double high = product + tail;
  return {high, tail - (high - product)};
}

}  // namespace octoblisk::detail
