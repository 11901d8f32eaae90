// Which triangles of a blade are on which of its sides.
#pragma once

#include <cstdint>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// What a triangle of a blisk is part of. The forward side faces towards greater angles about Z, the backward
/// side towards lesser ones; they meet at the edges.
enum class BladePart : std::uint8_t { not_of_blade, forward, backward, tip };

struct BladeSides {
  std::vector<BladePart> part_of_triangle;
  std::vector<int> blade_of_triangle;  ///< that of BladesFound, with the edges' triangles that it lacks
  bool faces_outward = true;           ///< whether normals point out of the blades
};

/// Tells a blisk's triangles (axis Z) apart by their outward normals n: the tip where n · e_r > 0.7, else the
/// sign of n · e_theta; then islands of less than 2 % of their blade take the part round them. Triangles
/// that the finder could not tell from the hub, at the edges near the root, come with their blade where they
/// go on smoothly from it and face along the axis.
/// Throws std::invalid_argument, where the blades are not of the mesh.
BladeSides findBladeSides(const TriangleMesh& blisk, const BladesFound& blades);

}  // namespace octoblisk::demos
