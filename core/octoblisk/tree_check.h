// Whether arrays from outside are a tree that queries can walk.
#pragma once

#include "octoblisk/tree_arrays.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

/// Throws std::invalid_argument that names the node or triangle unless the nodes are a tree in depth-first
/// order, no deeper than ClusteredOctree::kMaxDepth, over leaves that hold each of the mesh's triangles once,
/// with boxes that are finite, orthonormal and no larger than the mesh makes them. On such arrays no query
/// fails; that its answers are right only ClusteredOctree::validate tells.
void checkTree(const TreeArrays& tree, const TriangleMesh& mesh);

}  // namespace octoblisk
