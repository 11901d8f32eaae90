// Whether a mesh is closed and consistently oriented, with less work than a Surface.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Whether every edge, identified by the positions of its ends, is used equally often in both directions.
/// Gives the answer of Surface::isOriented in O(n) and without storing the edges: it compares sums of 64-bit
/// hashes of the edges of each direction. The answer is wrong with a chance of 2⁻⁶⁴, except for meshes made
/// to deceive it.
bool isOrientedClosed(const TriangleMesh& mesh);

}  // namespace octoblisk::detail
