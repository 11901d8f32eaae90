// What is told of something long, and asked, while it runs.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace octoblisk::demos {

/// All in the thread that runs it; either may be empty.
struct RunWatch {
  /// Tells that so many of the path's poses are done, of the task named.
  std::function<void(const std::string& task, std::size_t done)> progress = {};
  std::function<bool()> stop = {};  ///< whether to leave the rest

  void tell(const std::string& task, std::size_t done) const {
    if (progress) progress(task, done);
  }
  bool isStopped() const { return stop && stop(); }
};

}  // namespace octoblisk::demos
