// The support point of a mesh.
#pragma once

#include <cstdint>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The index of the vertex of the tree's triangles that is farthest in a direction, in the mesh's frame. Of
/// equally far vertices, one whose position is first by coordinates. Allocates nothing.
std::uint32_t farthestVertex(const ClusteredOctree& tree, const Vec3& direction);

}  // namespace octoblisk::detail
