// Shows the progress of long tasks at a terminal, and lets Ctrl-C stop them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "grinding/run_watch.h"
#include "io/progress_bar.h"
#include "render/picture.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {

/// During its lifetime each task has a progress bar, and Ctrl-C stops the watched task. Only one may exist at
/// a time.
class TerminalWatch {
 public:
  /// For tasks of `steps` steps each.
  explicit TerminalWatch(std::size_t steps) : steps_(steps) {}

  /// The result refers to this object.
  RunWatch watch();

  /// Removes the bar, for example before printing.
  void endTask() { bar_.reset(); }

  /// The exception to throw after a stop.
  static Stopped stopped(const std::string& message) { return {message, StopSignal::received()}; }

 private:
  StopSignal stop_signal_;
  std::size_t steps_;
  std::string task_;
  std::optional<ProgressBar> bar_;
};

/// Renders the page to a PNG file and shows the progress. Throws as writePng (picture.h).
void writePngWatched(const Picture& picture, const std::string& path);

}  // namespace octoblisk::demos
