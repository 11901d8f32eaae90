// Rules for a user's names that appear in tables and messages.
#pragma once

#include <algorithm>
#include <string_view>

namespace octoblisk::demos {

inline constexpr const char* kTableNameRule =
    "a name must consist of printable ASCII letters, without commas and double quotes";

inline bool isTableName(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char letter) {
    return letter >= ' ' && letter <= '~' && letter != ',' && letter != '"';
  });
}

}  // namespace octoblisk::demos
