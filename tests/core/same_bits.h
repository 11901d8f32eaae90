// Compares two trees to the last bit.
#pragma once

#include <algorithm>
#include <cstring>

#include "tree/tree.h"

namespace octoblisk {

inline bool sameBits(const ClusteredOctree& a, const ClusteredOctree& b) {
  const auto same = [](const auto& one, const auto& other) {
    if (one.size() != other.size()) return false;
    return one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0;
  };
  return std::ranges::equal(detail::treeOf(a).triangleOrder(), detail::treeOf(b).triangleOrder()) &&
         same(detail::treeOf(a).nodes(), detail::treeOf(b).nodes()) &&
         same(detail::treeOf(a).compactNodes(), detail::treeOf(b).compactNodes());
}

}  // namespace octoblisk
