#include "base/huge_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#endif

namespace octoblisk::detail {

void preferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::size_t kWorthwhile = std::size_t{4}
                                      << 20;  // two pages, because the first may start within the memory
  if (bytes < kWorthwhile) return;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const first = std::align(page, page, memory, bytes);  // updates `bytes` to the size from there on
  // This is only advice: if the system ignores it, nothing is lost.
  (void)madvise(first, bytes / page * page, MADV_HUGEPAGE);
#endif
}

}  // namespace octoblisk::detail
