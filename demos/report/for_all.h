// Many jobs on a few threads.
#pragma once

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace octoblisk::demos {

/// Does the jobs 0 … count − 1 on so many threads, each with a worker of its own: a function of the job, made
/// by `make_worker()`. Passes the first exception on.
template <class MakeWorker>
void forAll(int count, unsigned threads, const MakeWorker& make_worker) {
  std::atomic<int> next = 0;
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto run = [&] {
    try {
      auto worker = make_worker();
      for (int job = next++; job < count; job = next++) worker(job);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned index = 1; index < threads; ++index) helpers.emplace_back(run);
    run();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace octoblisk::demos
