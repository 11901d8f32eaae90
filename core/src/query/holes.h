// Which gaps of a mesh are holes, and which triangles are near them.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/surface.h"
#include "query/solid_parts.h"
#include "query/winding.h"

namespace octoblisk::detail {

/// Per triangle; empty if the mesh has no gap that can be seen.
struct Holes {
  std::vector<char> sees_hole;  // whether it is a sheet because of a hole
  std::vector<char> near_hole;  // SolidParts::near_hole
};

/// Finds the triangles that see holes of their component, and notes which gaps are holes. The part of a gap's
/// cap that is inside the solid is no hole.
Holes findHoles(const Surface& surface, const Winding& winding, std::span<Gap> gaps, int threads);

}  // namespace octoblisk::detail
