#include "commands/interrupt.h"

#include <atomic>

namespace octoblisk::demos {
namespace {

// A signal's handler can reach nothing else.
std::atomic<bool> was_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void noteInterrupt(int) { was_interrupted = true; }

}  // namespace

InterruptWatch::InterruptWatch() {
  was_interrupted = false;
  struct sigaction action = {};
  action.sa_handler = noteInterrupt;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool InterruptWatch::interrupted() { return was_interrupted; }

}  // namespace octoblisk::demos
