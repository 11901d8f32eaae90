#include "study/stop_signal.h"

#include <cstddef>

namespace octoblisk::demos {
namespace {

volatile sig_atomic_t stop_signal_received = 0;  // a signal handler may only write to such a variable

extern "C" void noteStopSignal(int signal) { stop_signal_received = signal; }

}  // namespace

StopSignal::StopSignal() {
  stop_signal_received = 0;
  struct sigaction note = {};
  note.sa_handler = noteStopSignal;
  note.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  ::sigemptyset(&note.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &note, nullptr);
  }
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before_[i], nullptr);
}

int StopSignal::received() { return stop_signal_received; }

}  // namespace octoblisk::demos
