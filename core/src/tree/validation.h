// Checks whether arrays are a valid tree, and whether a tree can be built from the input.
#pragma once

#include "tree/tree.h"

namespace octoblisk::detail {

/// Throws std::invalid_argument if the mesh is null, if it has too many triangles, or if an option is out of
/// range.
void checkBuild(const TriangleMesh* mesh, const BuildOptions& options);

/// Throws std::invalid_argument if the number of threads is negative.
void checkThreads(int threads);

/// Throws std::invalid_argument unless `deformed` is the mesh with moved vertices.
void checkDeformed(const TriangleMesh* deformed, const TriangleMesh& mesh);

/// Throws std::invalid_argument, which names the node or triangle, unless the nodes are a valid tree: in
/// depth-first order, no deeper than Tree::kMaxDepth, with each of the mesh's triangles in one leaf, and with
/// boxes that are finite, orthonormal and no larger than the mesh allows. No query fails on such arrays. Only
/// validate() shows that the answers are correct.
void checkTree(const TreeArrays& tree, const TriangleMesh& mesh);

/// Implements ClusteredOctree::validate.
void validate(const Tree& tree);

}  // namespace octoblisk::detail
