// What someone at a terminal sees of something long, and how he stops it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "grinding/run_watch.h"
#include "io/progress_bar.h"
#include "study/stop_signal.h"

namespace octoblisk::demos {

/// While it lives, each task has a bar, and Ctrl-C stops what is watched. One at a time.
class TerminalWatch {
 public:
  /// Of tasks of so many steps each.
  explicit TerminalWatch(std::size_t steps) : steps_(steps) {}

  /// Refers to this.
  RunWatch watch();

  /// Takes the bar away, e.g. before something is told.
  void endTask() { bar_.reset(); }

  /// What to throw after a stop.
  static Stopped stopped(const std::string& message) { return {message, StopSignal::received()}; }

 private:
  StopSignal stop_signal_;
  std::size_t steps_;
  std::string task_;
  std::optional<ProgressBar> bar_;
};

}  // namespace octoblisk::demos
