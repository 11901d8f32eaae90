// Converts a tree's nodes to compact nodes.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Converts a full tree to a compact tree.
void makeCompact(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads);

}  // namespace octoblisk::detail
