// New boxes for the nodes of a tree, in the frames that they have, round vertices that have moved.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Makes every box hold all vertices below it: axes and children stay, centres, half extents and the corners
/// in the leaves are computed anew, in the frames of compact nodes where they are such. `origin` and `radius`
/// are those of the mesh's bounds. The same to the last bit for any number of threads.
void refit(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads);

}  // namespace octoblisk::detail
