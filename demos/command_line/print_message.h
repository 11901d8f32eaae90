// Prints the messages of the command.
#pragma once

#include <algorithm>
#include <iostream>
#include <string>

namespace octoblisk::demos {

/// Writes one line to standard error: an error, a warning or a note. It stays one line even if the message
/// quotes control bytes from the user's input.
inline void printMessage(std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char byte) { return byte < ' ' || byte == 127; }, '?');
  std::cerr << "octoblisk: " << message << '\n';
}

/// Writes a warning about a file or part to standard error.
inline void warnOf(const std::string& of, const std::string& what) {
  printMessage("warning: " + of + ": " + what);
}

}  // namespace octoblisk::demos
