// Where to cut the blades of a blisk's mesh off its hub and shroud.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "models/growing_parts.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {

/// The parts of more than a crumb's size, if they are alike and equally spaced round the axis; else none.
std::vector<Part> bladesAmong(std::vector<Part> parts);

/// Between these radii the mesh falls into `count` blades.
struct BladeCut {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  int run = 0;  ///< of how many cuts in a row it is the lowest
};

/// The cut whose count of blades holds over the widest range of radii; count 0 where none holds over 5 % of
/// them.
BladeCut findBladeCut(const WeldedSurface& surface);

}  // namespace octoblisk::demos
