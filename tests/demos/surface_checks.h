// Checks a closed surface edge by edge and pair by pair.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// Whether every directed edge occurs once, and its reverse once.
bool isWatertight(const TriangleMesh& mesh);

/// Vertices − edges + triangles: 2 − 2·genus for a closed surface.
long eulerCharacteristic(const TriangleMesh& mesh);

/// The number of triangle pairs, sharing at most one vertex, in which an edge of one properly crosses the
/// other.
std::size_t countCrossings(const TriangleMesh& mesh);

}  // namespace octoblisk::demos
