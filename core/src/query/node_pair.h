// A pair of nodes, one of each of two trees.
#pragma once

#include <cstdint>

namespace octoblisk::detail {

/// Indices of nodes. The default is both roots.
struct NodePair {
  std::uint32_t a = 0, b = 0;
};

}  // namespace octoblisk::detail
