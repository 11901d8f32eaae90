// Triangles with the same corners as others.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/surface.h"

namespace octoblisk::detail {

/// Of several triangles with the same corners, the first stands for all, facing as most of them do. If as
/// many face the other way, the first of these stays too: both are the sides of a sheet. Triangles without
/// area are no copies.
struct Copies {
  std::vector<std::uint32_t> triangles;  // all but the first of each, ascending
  std::vector<std::uint32_t> original;   // per triangle: the one that stands for it
  std::vector<signed char> count;        // per original: 1, or -1 if it is to be turned
  bool are_left_out = false;             // whether some triangle has another original
};
Copies findCopies(const Surface& surface);

/// Whether two triangles with the same corners face the same way.
bool areSameWay(const Surface& surface, std::uint32_t a, std::uint32_t b);

}  // namespace octoblisk::detail
