// A demand on what the caller gives.
#pragma once

#include <stdexcept>
#include <string>

namespace octoblisk::demos {

/// Throws std::invalid_argument with the message unless it holds.
inline void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument(message);
}

}  // namespace octoblisk::demos
