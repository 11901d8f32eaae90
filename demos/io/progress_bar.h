// A progress bar for people at a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

namespace octoblisk::demos {

/// Draws a bar on one line of the stream, with the rate of steps and the time that is left at it, at most ten
/// times a second, and wipes it when destroyed. Writes
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

  void draw(std::size_t done, Clock::time_point now);

  std::ostream& stream_;
  std::size_t total_;
  bool shown_;          ///< whether anyone is there to see it
  bool drawn_ = false;  ///< whether there is something to wipe
  Clock::time_point start_;
  Clock::time_point next_draw_;
};

/// "1234 a second, 2 min 5 s left" for what is done after so many seconds; empty before there is a rate.
std::string rateAndTimeLeft(std::size_t done, std::size_t total, double seconds);

}  // namespace octoblisk::demos
