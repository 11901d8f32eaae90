// A shape over a mesh, with its own tree and no margin. Contacts are exact on the triangles.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_shape.h"
#include "shared/meshes.h"

namespace octoblisk {

inline ClusteredOctreeShape shapeOver(const testing::SharedMesh& mesh,
                                      std::vector<std::uint32_t> part_begin = {0}) {
  ClusteredOctreeShape shape(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)),
                             std::move(part_begin));
  shape.setMargin(0);
  return shape;
}

}  // namespace octoblisk
