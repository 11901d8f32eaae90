// Trees and shapes over meshes.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "shared/meshes.h"

namespace octoblisk {

inline std::shared_ptr<const ClusteredOctree> treeOver(const testing::SharedMesh& mesh,
                                                       const BuildOptions& options = {}) {
  return std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh, options));
}

/// Without a margin, so that contacts are exact on the triangles.
inline ClusteredOctreeShape shapeOver(const testing::SharedMesh& mesh,
                                      std::vector<std::uint32_t> part_begin = {0}) {
  ClusteredOctreeShape shape(treeOver(mesh), std::move(part_begin));
  shape.setMargin(0);
  return shape;
}

}  // namespace octoblisk
