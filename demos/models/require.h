// A precondition.
#pragma once

#include <stdexcept>
#include <string>

namespace octoblisk::demos {

/// Throws std::invalid_argument with the message unless `holds`.
inline void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument(message);
}

}  // namespace octoblisk::demos
