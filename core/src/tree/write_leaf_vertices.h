// The corners in all leaves of a full tree.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Writes the corners in all leaves of a full tree.
void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, int threads);

}  // namespace octoblisk::detail
