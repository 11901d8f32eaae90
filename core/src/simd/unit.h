// Scales lengths for arithmetic in single precision.
#pragma once

#include <bit>
#include <cstdint>

namespace octoblisk::detail {

/// A power of two that scales lengths up to `size` to about 1, so that their powers neither overflow nor
/// underflow.
inline float unitOf(float size) {
  constexpr std::uint32_t kExponent = 0x7f800000u, kOfOne = 0x3f800000u;
  return std::bit_cast<float>(2 * kOfOne - (std::bit_cast<std::uint32_t>(size) & kExponent));
}

}  // namespace octoblisk::detail
