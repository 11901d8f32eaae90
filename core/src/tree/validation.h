// What makes arrays a tree, and input one that a tree can be made of.
#pragma once

#include "tree/tree.h"

namespace octoblisk::detail {

/// Throws std::invalid_argument for no mesh, too many triangles, or an option out of its range.
void checkBuild(const TriangleMesh* mesh, const BuildOptions& options);

/// Throws std::invalid_argument for a negative number of threads.
void checkThreads(int threads);

/// Throws std::invalid_argument unless `deformed` is the mesh with its vertices moved.
void checkDeformed(const TriangleMesh* deformed, const TriangleMesh& mesh);

/// Throws std::invalid_argument that names the node or triangle unless the nodes are a tree in depth-first
/// order, no deeper than Tree::kMaxDepth, over leaves that hold each of the mesh's triangles once, with boxes
/// that are finite, orthonormal and no larger than the mesh makes them. On such arrays no query fails; only
/// validate() shows that its answers are right.
void checkTree(const TreeArrays& tree, const TriangleMesh& mesh);

/// ClusteredOctree::validate.
void validate(const Tree& tree);

}  // namespace octoblisk::detail
