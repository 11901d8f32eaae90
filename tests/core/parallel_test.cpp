// Parallel loops visit every index once. An exception thrown in a thread reaches the caller.
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace octoblisk {

using namespace detail;

namespace {

TEST(ParallelFor, visitsEveryIndexOnceAndWorkersAreNumbered) {
  for (const int threads : {0, 1, 2, 3, 8}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      std::atomic<bool> worker_is_known = true;
      parallelFor(count, threads, [&](std::size_t index, std::size_t worker) {
        ++visits[index];
        if (worker >= static_cast<std::size_t>(threadCount(threads))) worker_is_known = false;
      });
      EXPECT_TRUE(std::ranges::all_of(visits, [](const std::atomic<int>& n) { return n == 1; }));
      EXPECT_TRUE(worker_is_known);
    }
  }
}

TEST(ParallelFor, chunksCoverEveryIndexOnce) {
  for (const int threads : {0, 1, 3}) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{64}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      parallelForChunks(count, 64, threads, [&](std::size_t begin, std::size_t end) {
        EXPECT_EQ(begin % 64, 0u);
        EXPECT_EQ(end, std::min(count, begin + 64));
        for (; begin < end; ++begin) ++visits[begin];
      });
      EXPECT_TRUE(std::ranges::all_of(visits, [](const std::atomic<int>& n) { return n == 1; }));
    }
  }
}

TEST(ParallelFor, throwsWhatABodyThrew) {
  for (const int threads : {1, 4}) {
    std::atomic<int> visits = 0;
    std::atomic<bool> has_thrown = false;
    try {
      parallelFor(100000, threads, [&](std::size_t index, std::size_t) {
        ++visits;
        if (index == 17) {
          has_thrown = true;
          throw std::runtime_error("at " + std::to_string(index));
        }
        if (index < 17) return;
        // The other threads must not finish the work before the exception stops them.
        while (!has_thrown) std::this_thread::yield();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "at 17");
    }
    EXPECT_LT(visits, 100000);  // the remaining work is not started
  }
}

TEST(ParallelFor, throwsAtAnyIndexAndFromAllThreads) {
  for (const int threads : {1, 2, 8}) {
    for (const std::size_t bad : {std::size_t{0}, std::size_t{500}, std::size_t{999}}) {
      const auto throwAtBad = [&](std::size_t index, std::size_t) {
        if (index == bad) throw std::runtime_error("bad");
      };
      EXPECT_THROW(parallelFor(1000, threads, throwAtBad), std::runtime_error);
    }
    const auto throwAlways = [](std::size_t, std::size_t) { throw std::bad_alloc(); };
    EXPECT_THROW(parallelFor(1000, threads, throwAlways), std::bad_alloc);
  }
}

}  // namespace
}  // namespace octoblisk
