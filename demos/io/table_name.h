// Names of the user's that go to tables and messages as they are.
#pragma once

#include <algorithm>
#include <string_view>

namespace octoblisk::demos {

inline constexpr const char* kTableNameRule =
    "a name must be of printable ASCII letters, without comma and double quote";

inline bool isTableName(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char letter) {
    return letter >= ' ' && letter <= '~' && letter != ',' && letter != '"';
  });
}

}  // namespace octoblisk::demos
