// Writes numbers as text.
#pragma once

#include <charconv>
#include <cstddef>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>

namespace octoblisk::demos {

/// With as many digits as a double needs to be read back exactly, like printf's %.17g.
inline std::string exactText(double value) {
  constexpr std::size_t kRoom = 32;
  char digits[kRoom];
  const auto end = std::to_chars(digits, digits + kRoom, value, std::chars_format::general,
                                 std::numeric_limits<double>::max_digits10);
  return {digits, end.ptr};
}

/// With this number of digits after the point.
inline std::string fixedText(double value, int digits) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

/// With four significant digits.
inline std::string shortText(double value) {
  std::ostringstream text;
  text << std::setprecision(4) << value;
  return text.str();
}

/// "+3.2 %": the change from the first value, which is not 0, to the second.
inline std::string changeText(double from, double to, int digits = 1) {
  const std::string text = fixedText(100.0 * (to / from - 1.0), digits);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  if (is_zero) return fixedText(0.0, digits) + " %";
  return (text.front() == '-' ? "" : "+") + text + " %";
}

/// "37.5 %" of a whole that is not 0.
inline std::string shareText(double part, double whole, int digits = 1) {
  return fixedText(100.0 * part / whole, digits) + " %";
}

/// "3 of 40 (7.5 %)"; without the share if the whole is 0.
inline std::string partText(std::size_t part, std::size_t whole) {
  const std::string text = std::to_string(part) + " of " + std::to_string(whole);
  if (whole == 0) return text;
  return text + " (" + shareText(static_cast<double>(part), static_cast<double>(whole)) + ")";
}

/// "1 pose", "3 poses".
inline std::string countedText(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

}  // namespace octoblisk::demos
