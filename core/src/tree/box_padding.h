// How much every box of a tree is grown.
#pragma once

#include <limits>

namespace octoblisk::detail {

/// Room for the rounding of vertices, projections and box centres to single precision, on each side of every
/// box of a tree with that radius.
inline float boxPadding(double radius) {
  constexpr double kRounding = 0x1p-20;  // of the radius: sixteen units in the last place
  constexpr auto kSmallest = static_cast<double>(std::numeric_limits<float>::min());
  return static_cast<float>(kRounding * radius + kSmallest);
}

}  // namespace octoblisk::detail
