// Ctrl-C, and a batch system's word that time is up.
#pragma once

#include <signal.h>

#include <array>
#include <stdexcept>
#include <string>

namespace octoblisk::demos {

/// While it lives, SIGINT and SIGTERM do not end the process but are told by received(); the second one does
/// end it. What the process was told to ignore, it ignores. There may be one at a time.
class StopSignal {
 public:
  StopSignal();
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// The signal that came, or 0.
  static int received();

 private:
  static constexpr std::array<int, 2> kSignals = {SIGINT, SIGTERM};
  std::array<struct sigaction, kSignals.size()> before_;
};

/// A run that was told to stop before its end.
class Stopped : public std::runtime_error {
 public:
  Stopped(const std::string& message, int signal) : std::runtime_error(message), signal_(signal) {}

  /// As shells tell it: 128 + the signal.
  int exitCode() const { return 128 + signal_; }

 private:
  int signal_;
};

}  // namespace octoblisk::demos
