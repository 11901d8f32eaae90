// The support point of a mesh.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// The vertex of the tree's triangles that is farthest in a direction, in the mesh's frame. Of equally far
/// vertices, the first by coordinates. Allocates nothing.
Vec3 farthestVertex(const ClusteredOctree& tree, const Vec3& direction);

}  // namespace octoblisk::detail
