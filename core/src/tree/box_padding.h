// The padding of every box of a tree.
#pragma once

#include <limits>

namespace octoblisk::detail {

/// The padding on each side of every box of a tree with this radius. It allows for the rounding of vertices,
/// projections and box centres to single precision.
inline float boxPadding(double radius) {
  constexpr double kRounding = 0x1p-20;  // relative to the radius: sixteen units in the last place
  constexpr auto kSmallest = static_cast<double>(std::numeric_limits<float>::min());
  return static_cast<float>(kRounding * radius + kSmallest);
}

}  // namespace octoblisk::detail
