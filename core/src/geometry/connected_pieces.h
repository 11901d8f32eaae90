// Which vertices of a mesh are connected.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// For each vertex, one vertex of its piece, the same for the whole piece. Triangles are connected by corners
/// at equal positions. A vertex that no triangle uses may be a piece by itself.
std::vector<std::uint32_t> connectedPieces(const TriangleMesh& mesh);

}  // namespace octoblisk::detail
