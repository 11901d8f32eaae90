// Visits the nodes of a tree on several threads.
#pragma once

#include <algorithm>

#include "base/parallel.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Calls visit(node) for the index of every node, in any order.
template <typename Visit>
void forEachNode(const TreeArrays& tree, int threads, const Visit& visit) {
  constexpr std::size_t kChunk = 64;
  const std::size_t count = tree.nodeCount();
  parallelFor((count + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, std::size_t) {
    const std::size_t end = std::min(count, (chunk + 1) * kChunk);
    for (std::size_t n = chunk * kChunk; n < end; ++n) visit(static_cast<std::uint32_t>(n));
  });
}

}  // namespace octoblisk::detail
