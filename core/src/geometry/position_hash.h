// A hash of positions.
#pragma once

#include <bit>
#include <cstdint>

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// A bijection that spreads every bit of the input over the whole output (splitmix64's last steps).
inline std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

/// Equal for equal positions; −0 is 0.
inline std::uint64_t hashOf(const Vec3& position) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  for (const double coordinate : position) {
    hash = mixed(hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) + 0x9e3779b97f4a7c15u;
  }
  return hash;
}

}  // namespace octoblisk::detail
