// Parallel loops over independent parts of a task.
#pragma once

#include <cstddef>
#include <functional>

namespace octoblisk::detail {

/// The number of threads for a request: the number itself, or, for 0 or less, as many as the machine runs at
/// once.
int threadCount(int requested);

/// Calls body(index, worker) once for each index below `count`, in any order, on up to threadCount(threads)
/// threads including the caller's. `worker` < threadCount(threads) numbers the thread, so that each may have
/// its own scratch memory. Returns after all calls have returned. After a call has thrown, no further calls
/// start, and one of the exceptions is rethrown.
void parallelFor(std::size_t count, int threads,
                 const std::function<void(std::size_t index, std::size_t worker)>& body);

/// parallelFor over chunks of consecutive indices: calls body(begin, end) for 0 to chunk_size,
/// chunk_size to 2 · chunk_size, …; the last chunk ends at `count`.
void parallelForChunks(std::size_t count, std::size_t chunk_size, int threads,
                       const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace octoblisk::detail
