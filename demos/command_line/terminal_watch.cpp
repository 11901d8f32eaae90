#include "command_line/terminal_watch.h"

#include <iostream>
#include <optional>

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

void writePngWatched(const Picture& picture, const std::string& path) {
  std::optional<ProgressBar> bar;
  const Image page = render(picture, kPageWidth, kPageHeight, 0, [&](std::size_t done, std::size_t bands) {
    if (!bar) bar.emplace(std::cerr, bands);
    bar->update(done);
  });
  writePng(page, path);
}

}  // namespace octoblisk::demos
