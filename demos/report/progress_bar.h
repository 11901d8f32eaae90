// A progress bar for people at a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <ostream>

namespace octoblisk::demos {

/// Draws a bar on one line of the stream, at most ten times a second, and wipes it when destroyed. Writes
/// nothing where standard error is no terminal, e.g. in a pipe. For one thread.
class ProgressBar {
 public:
  /// For `total` steps. The stream (std::cerr, as a rule) must outlive the bar.
  ProgressBar(std::ostream& stream, std::size_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Tells that so many steps are done, 0 … total.
  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::size_t done);

  std::ostream& stream_;
  std::size_t total_;
  bool shown_;          ///< whether anyone is there to see it
  bool drawn_ = false;  ///< whether there is something to wipe
  Clock::time_point next_draw_;
};

}  // namespace octoblisk::demos
