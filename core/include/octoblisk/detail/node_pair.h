// A node of each of two trees.
#pragma once

#include <cstdint>

namespace octoblisk::detail {

/// Indices of nodes. By default the first nodes: all of both trees is below them.
struct NodePair {
  std::uint32_t a = 0, b = 0;
};

}  // namespace octoblisk::detail
