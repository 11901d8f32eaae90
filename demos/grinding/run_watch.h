// Callbacks of a long task: progress, and whether to stop.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace octoblisk::demos {

/// They are called in the thread that runs the task; either may be empty.
struct RunWatch {
  /// Reports how many of the path's poses are done in the named task.
  std::function<void(const std::string& task, std::size_t done)> progress = {};
  std::function<bool()> stop = {};  ///< true to skip the rest

  void report(const std::string& task, std::size_t done) const {
    if (progress) progress(task, done);
  }
  bool isStopped() const { return stop && stop(); }
};

}  // namespace octoblisk::demos
