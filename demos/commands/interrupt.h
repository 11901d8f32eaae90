// Ctrl-C as a wish to stop soon and keep what is done.
#pragma once

#include <csignal>

namespace octoblisk::demos {

/// While it lives, the first SIGINT or SIGTERM is noted; a second one ends the program as ever. One at a
/// time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  static bool interrupted();

 private:
  struct sigaction interrupt_before_ = {}, terminate_before_ = {};
};

}  // namespace octoblisk::demos
