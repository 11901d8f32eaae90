#include "command_line/option_checks.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string>
#include <string_view>

#include "io/quoted_text.h"

namespace octoblisk::demos {
namespace {

template <typename Number>
bool parse(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && stop == text.data() + text.size();
}

}  // namespace

CLI::Validator numberFrom(double least, double greatest, bool above) {
  const auto check = [=](const std::string& text) -> std::string {
    double value = 0.0;
    // The comparisons are false for NaN.
    if (parse(text, value) && value <= greatest && (above ? value > least : value >= least)) return {};
    std::ostringstream message;
    message.precision(12);
    message << inQuotes(text) << " is not a number " << (above ? "above " : "from ") << least
            << (above ? " and at most " : " to ") << greatest;
    return message.str();
  };
  return CLI::Validator(check, "");
}

CLI::Validator wholeNumberFrom(std::int64_t least, std::int64_t greatest) {
  const auto check = [=](const std::string& text) -> std::string {
    std::int64_t value = 0;
    if (parse(text, value) && value >= least && value <= greatest) return {};
    return inQuotes(text) + " is not a whole number from " + std::to_string(least) + " to " +
           std::to_string(greatest);
  };
  return CLI::Validator(check, "");
}

CLI::Validator oneOf(const std::vector<std::string>& values) {
  const auto check = [=](const std::string& text) -> std::string {
    if (std::ranges::find(values, text) != values.end()) return {};
    return inQuotes(text) + " is not one of " + CLI::detail::join(values, ", ");
  };
  return CLI::Validator(check, '{' + CLI::detail::join(values, ",") + '}');
}

CLI::Validator notEmpty() {
  return CLI::Validator(
      [](const std::string& text) { return std::string(text.empty() ? "the name is empty" : ""); }, "");
}

}  // namespace octoblisk::demos
