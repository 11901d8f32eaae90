// A progress bar at a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

namespace octoblisk::demos {

/// Draws a bar on one line of the stream, with the rate of steps and the remaining time, at most ten times a
/// second. Erases it when destroyed. Writes nothing if standard error is not a terminal, e.g. in a pipe. Use
/// it from one thread.
class ProgressBar {
 public:
  /// For `total` steps. The stream, usually std::cerr, must outlive the bar.
  ProgressBar(std::ostream& stream, std::size_t total);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Reports the number of finished steps, 0 … total.
  void update(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(std::size_t done, Clock::time_point now);

  std::ostream& stream_;
  std::size_t total_;
  bool shown_;          ///< whether standard error is a terminal
  bool drawn_ = false;  ///< whether a bar must be erased
  Clock::time_point start_;
  Clock::time_point next_draw_;
};

/// "1234 per second, 2 min 5 s left", given the finished steps and the elapsed seconds; empty before there is
/// a rate.
std::string rateAndTimeLeft(std::size_t done, std::size_t total, double seconds);

}  // namespace octoblisk::demos
