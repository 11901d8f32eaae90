// Numbers that are read back as they are.
#pragma once

#include <charconv>
#include <limits>
#include <string>

namespace octoblisk::demos {

/// With all digits that a double needs: as printf's %.17g.
inline std::string exactText(double value) {
  constexpr std::size_t kRoom = 32;
  char digits[kRoom];
  const auto end = std::to_chars(digits, digits + kRoom, value, std::chars_format::general,
                                 std::numeric_limits<double>::max_digits10);
  return {digits, end.ptr};
}

}  // namespace octoblisk::demos
