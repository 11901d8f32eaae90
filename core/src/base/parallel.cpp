#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace octoblisk::detail {

int threadCount(int requested) {
  return requested > 0 ? requested : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallelFor(std::size_t count, int threads,
                 const std::function<void(std::size_t index, std::size_t worker)>& body) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&](std::size_t worker) {
    try {
      for (std::size_t index = next++; index < count; index = next++) body(index, worker);
    } catch (...) {
      next = count;
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t wanted = std::min(count, static_cast<std::size_t>(threadCount(threads)));
    helpers.reserve(wanted);
    try {
      while (helpers.size() + 1 < wanted) helpers.emplace_back(work, helpers.size() + 1);
    } catch (const std::system_error&) {
      // The system has no more threads: those that exist do the work.
    }
    work(0);
  }
  if (failure) std::rethrow_exception(failure);
}

void parallelForChunks(std::size_t count, std::size_t chunk_size, int threads,
                       const std::function<void(std::size_t begin, std::size_t end)>& body) {
  parallelFor((count + chunk_size - 1) / chunk_size, threads, [&](std::size_t chunk, std::size_t) {
    const std::size_t begin = chunk * chunk_size;
    body(begin, std::min(count, begin + chunk_size));
  });
}

}  // namespace octoblisk::detail
