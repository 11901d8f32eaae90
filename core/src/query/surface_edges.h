// The edges of a surface, and the triangles that use them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "octoblisk/surface.h"

namespace octoblisk::detail {

/// A triangle that uses an edge.
struct EdgeUse {
  std::uint32_t other;  // the edge's greater corner
  std::uint32_t triangle;
  bool is_forward;  // towards `other`
};

/// Calls visit(corner, uses) for each edge: its lower corner, and its uses in ascending order of triangles.
/// Leaves out the triangles for which is_left_out(triangle) is true, and those with two equal corners: they
/// run there and back.
template <typename IsLeftOut, typename Visit>
void forEachEdge(const Surface& surface, const IsLeftOut& is_left_out, const Visit& visit) {
  std::vector<EdgeUse> uses;
  for (std::uint32_t corner = 0; corner < surface.cornerCount(); ++corner) {
    uses.clear();
    for (const std::uint32_t t : surface.star(corner)) {
      const auto& [a, b, c] = surface.corners(t);
      if (a == b || b == c || c == a || is_left_out(t)) continue;
      const std::uint32_t next = a == corner ? b : b == corner ? c : a;
      const std::uint32_t last = a == corner ? c : b == corner ? a : b;
      if (next > corner) uses.push_back({next, t, true});
      if (last > corner) uses.push_back({last, t, false});
    }
    std::ranges::sort(uses, {}, [](const EdgeUse& use) { return std::pair(use.other, use.triangle); });
    for (auto begin = uses.cbegin(), end = begin; begin != uses.cend(); begin = end) {
      end = std::find_if(begin, uses.cend(), [&](const EdgeUse& use) { return use.other != begin->other; });
      visit(corner, std::span<const EdgeUse>(begin, end));
    }
  }
}

}  // namespace octoblisk::detail
