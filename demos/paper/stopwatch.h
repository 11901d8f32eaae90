// Times an experiment.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace octoblisk::demos {

/// The processor time of the calling thread, which depends little on other load of the machine.
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

/// Needs at least one value. The median of an even number of values is the mean of the two in the middle.
inline double medianOf(std::vector<double> values) {
  std::ranges::sort(values);
  return 0.5 * (values[values.size() / 2] + values[(values.size() - 1) / 2]);
}

}  // namespace octoblisk::demos
