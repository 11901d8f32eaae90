// Large pages for memory that queries read in no order: a miss of the address translation costs as much as
// one of the cache.
#pragma once

#include <cstddef>
#include <vector>

namespace octoblisk::detail {

/// Asks the system for large pages where it has them, of memory that is not written yet; else does nothing.
void preferHugePages(void* memory, std::size_t bytes);

/// Reserves room on large pages, where that is worth it. The vector must be empty.
template <typename Item>
void reserveOnHugePages(std::vector<Item>& items, std::size_t count) {
  items.reserve(count);
  preferHugePages(items.data(), count * sizeof(Item));
}

}  // namespace octoblisk::detail
