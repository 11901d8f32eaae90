// Builds a mesh's tree with the default options, for sharing.
#pragma once

#include <memory>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// Throws as ClusteredOctree::build.
std::shared_ptr<const ClusteredOctree> treeOf(std::shared_ptr<const TriangleMesh> mesh);
std::shared_ptr<const ClusteredOctree> treeOf(TriangleMesh mesh);

}  // namespace octoblisk::demos
