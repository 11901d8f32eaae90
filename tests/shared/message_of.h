// The message with which an action is refused.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace octoblisk::testing {

/// The message of the std::invalid_argument that an action throws; "accepted" if it throws none.
inline std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace octoblisk::testing
