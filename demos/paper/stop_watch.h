// How long something takes: by the clock, and of this thread's processor time.
#pragma once

#include <chrono>
#include <ctime>

namespace octoblisk::demos {

/// In seconds. Processor time leaves out what other work on the machine takes from this thread.
struct TimeTaken {
  double clock = 0.0;
  double processor = 0.0;
};

class StopWatch {
 public:
  TimeTaken taken() const {
    const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
    return {clock.count(), processorTime() - processor_};
  }

 private:
  static double processorTime() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double processor_ = processorTime();
};

}  // namespace octoblisk::demos
