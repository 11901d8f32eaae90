// Divides the triangles of a blade among its sides.
#pragma once

#include <cstdint>
#include <vector>

#include "models/blade_finder.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The part of a blade that a triangle belongs to. The forward side faces towards greater angles about Z, the
/// backward side towards lesser ones; they meet at the edges.
enum class BladePart : std::uint8_t { not_of_blade, forward, backward, tip };

struct BladeSides {
  std::vector<BladePart> part_of_triangle;
  std::vector<int> blade_of_triangle;  ///< that of BladesFound, completed by the triangles at the edges
  bool faces_outward = true;           ///< whether normals point out of the blades
};

/// Classifies a blisk's triangles (axis Z) by their outward normals n: tip if n · e_r > 0.7, otherwise by the
/// sign of n · e_theta. Then islands of less than 2 % of their blade join the part around them. Triangles at
/// the edges near the root, which the finder could not tell from the hub, join their blade if they continue
/// it smoothly and face along the axis. Throws std::invalid_argument if the blades are not for this mesh.
BladeSides findBladeSides(const TriangleMesh& blisk, const BladesFound& blades);

}  // namespace octoblisk::demos
