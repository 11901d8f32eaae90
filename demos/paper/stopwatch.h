// The processor time of the calling thread, which depends little on other load of the machine.
#pragma once

#include <ctime>

namespace octoblisk::demos {

class Stopwatch {
 public:
  Stopwatch() : start_(now()) {}
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    std::timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  double start_;
};

}  // namespace octoblisk::demos
