// Parallel loops visit every index once. An exception thrown in a thread reaches the caller.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace octoblisk {

using namespace detail;

namespace {

TEST(ParallelFor, visitsEveryIndexOnceAndWorkersAreNumbered) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> visits(1000);
    std::atomic<bool> worker_is_known = true;
    parallelFor(visits.size(), threads, [&](std::size_t index, std::size_t worker) {
      ++visits[index];
      if (worker >= static_cast<std::size_t>(threads)) worker_is_known = false;
    });
    for (const std::atomic<int>& count : visits) ASSERT_EQ(count, 1);
    EXPECT_TRUE(worker_is_known);
  }
}

TEST(ParallelFor, throwsWhatABodyThrew) {
  for (const int threads : {1, 4}) {
    std::atomic<int> visits = 0;
    std::atomic<bool> is_thrown = false;
    try {
      parallelFor(100000, threads, [&](std::size_t index, std::size_t) {
        ++visits;
        if (index == 17) {
          is_thrown = true;
          throw std::runtime_error("at " + std::to_string(index));
        }
        // The other threads must not finish the work while this exception is on its way.
        if (is_thrown) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "at 17");
    }
    EXPECT_LT(visits, 100000);  // the remaining work is not started
  }
}

}  // namespace
}  // namespace octoblisk
