// Products of 64-bit integers in 128 bits, also if the compiler has no 128-bit integers.
#pragma once

#include <cstdint>

namespace octoblisk::detail {

struct WideProduct {
  std::uint64_t low, high;
};

/// The product, computed from the products of 32-bit halves.
constexpr WideProduct productOfHalves(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kHalf = 0xffffffffu;
  const std::uint64_t low = (a & kHalf) * (b & kHalf), left = (a >> 32) * (b & kHalf);
  const std::uint64_t right = (a & kHalf) * (b >> 32), high = (a >> 32) * (b >> 32);
  const std::uint64_t middle = (low >> 32) + (left & kHalf) + right;  // cannot overflow
  return {middle << 32 | (low & kHalf), high + (left >> 32) + (middle >> 32)};
}

constexpr WideProduct product(std::uint64_t a, std::uint64_t b) {
#ifdef __SIZEOF_INT128__
  __extension__ using Wide = unsigned __int128;
  const Wide wide = static_cast<Wide>(a) * b;
  return {static_cast<std::uint64_t>(wide), static_cast<std::uint64_t>(wide >> 64)};
#else
  return productOfHalves(a, b);
#endif
}

}  // namespace octoblisk::detail
