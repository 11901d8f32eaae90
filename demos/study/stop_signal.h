// Handles Ctrl-C, and the signal by which a batch system ends a job.
#pragma once

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

namespace octoblisk::demos {

/// During its lifetime, the first SIGINT or SIGTERM does not end the process but is reported by received();
/// the second one does end it. Signals that the process already ignores stay ignored. Only one may exist at a
/// time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// The signal received, or 0.
  static int received();

 private:
  static constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};
  std::array<void (*)(int), kSignals.size()> before_;
};

/// A run that was stopped before its end.
class Stopped : public std::runtime_error {
 public:
  Stopped(const std::string& message, int signal) : std::runtime_error(message), signal_(signal) {}

  /// The convention of shells: 128 + the signal.
  int exitCode() const { return 128 + signal_; }

 private:
  int signal_;
};

}  // namespace octoblisk::demos
