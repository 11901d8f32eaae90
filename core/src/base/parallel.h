// Loops over independent parts of a task on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace octoblisk::detail {

/// The number of threads that `requested` stands for: itself, or for 0 as many as the machine runs at once.
int threadCount(int requested);

/// Calls body(index, worker) for each index below `count`, once each, in no particular order, on up to
/// `threads` threads, the caller's among them; `worker` < threads numbers the thread, so that each may have
/// scratch memory of its own. Returns when all calls have. After a call has thrown no further ones are begun,
/// and one of the exceptions is thrown on.
void parallelFor(std::size_t count, int threads,
                 const std::function<void(std::size_t index, std::size_t worker)>& body);

}  // namespace octoblisk::detail
