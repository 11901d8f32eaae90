#include "base/huge_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

#include <memory>
#endif

namespace octoblisk::detail {

void preferHugePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::size_t kWorthwhile = std::size_t{4} << 20;  // two pages, of which one may start within
  if (bytes < kWorthwhile) return;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const first = std::align(page, page, memory, bytes);  // and `bytes` is what there is from there on
  // Only advice: where the system does not take it, nothing is lost.
  (void)madvise(first, bytes / page * page, MADV_HUGEPAGE);
#endif
}

}  // namespace octoblisk::detail
