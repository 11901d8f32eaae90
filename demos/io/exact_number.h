// Writes numbers so that they are read back exactly.
#pragma once

#include <charconv>
#include <limits>
#include <string>

namespace octoblisk::demos {

/// With as many digits as a double needs, like printf's %.17g.
inline std::string exactText(double value) {
  constexpr std::size_t kRoom = 32;
  char digits[kRoom];
  const auto end = std::to_chars(digits, digits + kRoom, value, std::chars_format::general,
                                 std::numeric_limits<double>::max_digits10);
  return {digits, end.ptr};
}

}  // namespace octoblisk::demos
