// Converts a full tree to a compact tree.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

void makeCompact(OwnedArrays& tree, const TriangleMesh& mesh, int threads);

}  // namespace octoblisk::detail
