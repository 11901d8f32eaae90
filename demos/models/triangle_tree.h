// Builds a tree of some triangles of a mesh.
#pragma once

#include <memory>
#include <vector>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// The triangles keep their order. Unused vertices are left out, because they would enlarge the mesh's
/// bounds. Throws as ClusteredOctree::build.
std::shared_ptr<const ClusteredOctree> treeOfTriangles(const TriangleMesh& mesh,
                                                       std::vector<TriangleMesh::Indices> triangles);

}  // namespace octoblisk::demos
