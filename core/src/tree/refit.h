// Refits the boxes of a tree, in their existing frames, to vertices that have moved.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Makes every box contain all vertices below it. Axes and children stay. Centres, half extents and the
/// corners in the leaves are recomputed; compact nodes use the frames of their compact rotations. The result
/// is the same to the last bit for any number of threads.
void refit(OwnedArrays& tree, const TriangleMesh& mesh, int threads);

}  // namespace octoblisk::detail
