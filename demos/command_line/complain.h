// What the command says of what is wrong.
#pragma once

#include <algorithm>
#include <iostream>
#include <string>

namespace octoblisk::demos {

/// One line on the standard error, whatever control bytes a user's words and file names brought along.
inline void complain(std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char byte) { return byte < ' ' || byte == 127; }, '?');
  std::cerr << "octoblisk: " << message << '\n';
}

}  // namespace octoblisk::demos
