// Writes the corners in all leaves of a full tree.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, int threads);

}  // namespace octoblisk::detail
