// Visits the nodes of a tree on several threads.
#pragma once

#include "base/parallel.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Calls visit(node) for the index of every node, in any order.
template <typename Visit>
void forEachNode(const TreeArrays& tree, int threads, const Visit& visit) {
  constexpr std::size_t kChunk = 64;
  parallelForChunks(tree.nodeCount(), kChunk, threads, [&](std::size_t n, std::size_t end) {
    for (; n < end; ++n) visit(static_cast<std::uint32_t>(n));
  });
}

}  // namespace octoblisk::detail
