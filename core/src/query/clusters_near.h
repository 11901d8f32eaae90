// Whether the clusters of a tree are near something. A broadphase uses this test before it looks at
// triangles.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// Whether one of the tree's boxes at a depth (ClusteredOctree::boxes) may be within `reach` of a box in the
/// mesh's frame. True if a triangle is that near. False if every such box is farther away along one of its
/// own axes or one of the other box's. The search descends from the root's box, which has depth 0, and ends
/// with the first box that is near. A negative depth counts as 0; from ClusteredOctree::kMaxDepth on, the
/// boxes are those of the leaves. Allocates nothing. False if the box is not finite.
bool clustersNear(const ClusteredOctree& tree, const Obb& box_in_tree, double reach, int depth);

/// The same for the boxes of two trees, both at the given depth.
bool clustersNear(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double reach,
                  int depth);

}  // namespace octoblisk::detail
