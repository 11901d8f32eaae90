// New boxes for the nodes of a tree, in the frames that they have, round vertices that have moved.
#pragma once

#include "octoblisk/triangle_mesh.h"
#include "tree/tree_arrays.h"

namespace octoblisk::detail {

/// Room for the rounding of vertices, projections and box centres to single precision, on each side of every
/// box of a tree with that radius.
float boxPadding(double radius);

/// Makes every box hold all vertices below it: axes and children stay, centres, half extents and the corners
/// in the leaves are computed anew, in the frames of compact nodes where they are such. `origin` and `radius`
/// are those of the mesh's bounds. The same to the last bit for any number of threads.
void refit(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads);

/// Writes the corners in all leaves of a full tree.
void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, int threads);

/// Makes a full tree a compact one.
void makeCompact(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, double radius, int threads);

}  // namespace octoblisk::detail
