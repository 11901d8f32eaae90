// A tree's nodes as compact ones.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Makes a full tree a compact one.
void makeCompact(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads);

}  // namespace octoblisk::detail
