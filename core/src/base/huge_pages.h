// Large pages for memory that queries read in random order: a miss of the address translation costs as much
// as a cache miss.
#pragma once

#include <cstddef>
#include <vector>

namespace octoblisk::detail {

/// Asks the system for large pages for memory that is not written yet; does nothing on systems without them.
void preferHugePages(void* memory, std::size_t bytes);

/// Reserves memory on large pages if that is worthwhile. The vector must be empty.
template <typename Item>
void reserveOnHugePages(std::vector<Item>& items, std::size_t count) {
  items.reserve(count);
  preferHugePages(items.data(), count * sizeof(Item));
}

}  // namespace octoblisk::detail
