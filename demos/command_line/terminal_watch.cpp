#include "command_line/terminal_watch.h"

#include <iostream>

namespace octoblisk::demos {

RunWatch TerminalWatch::watch() {
  RunWatch watch;
  watch.progress = [this](const std::string& task, std::size_t done) {
    if (!bar_ || task != task_) {
      bar_.reset();  // erases its line
      bar_.emplace(std::cerr, steps_);
    }
    task_ = task;
    bar_->update(done);
  };
  watch.stop = [] { return StopSignal::received() != 0; };
  return watch;
}

}  // namespace octoblisk::demos
