#include "study/stop_signal.h"

#include <cstddef>

namespace octoblisk::demos {
namespace {

volatile std::sig_atomic_t stop_signal_received = 0;  // a signal handler may only write to such a variable

extern "C" void noteStopSignal(int signal) {
  stop_signal_received = signal;
  std::signal(signal, SIG_DFL);
}

}  // namespace

// glibc restarts the system calls that these signals interrupt.
StopSignal::StopSignal() {
  stop_signal_received = 0;
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    before_[i] = std::signal(kSignals[i], noteStopSignal);
    if (before_[i] == SIG_IGN) std::signal(kSignals[i], SIG_IGN);
  }
}

StopSignal::~StopSignal() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before_[i]);
}

int StopSignal::received() { return stop_signal_received; }

}  // namespace octoblisk::demos
