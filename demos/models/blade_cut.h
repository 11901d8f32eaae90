// Finds the radii at which to cut the blades of a blisk's mesh off its hub and shroud.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "models/growing_parts.h"
#include "models/welded_surface.h"

namespace octoblisk::demos {

/// The parts larger than a crumb, if they are alike and equally spaced around the axis; otherwise none.
std::vector<Part> bladesAmong(std::vector<Part> parts);

/// The mesh falls into `count` blades between these radii.
struct BladeCut {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  int run = 0;  ///< number of successive cuts; this cut is the lowest
};

/// The cut whose count of blades holds over the widest range of radii; count 0 if none holds over 5 % of
/// them.
BladeCut findBladeCut(const WeldedSurface& surface);

}  // namespace octoblisk::demos
