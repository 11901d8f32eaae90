// Whether the clusters of a tree come near something: what a broadphase asks before any triangle is looked
// at.
#pragma once

#include "octoblisk/clustered_octree.h"

namespace octoblisk::detail {

/// Whether one of the tree's boxes at a depth (ClusteredOctree::boxes) may be within `reach` of a box in the
/// mesh's frame: true wherever a triangle is that near; false wherever every such box is farther away along
/// one of its own axes or the other box's. The search goes down from the root's box, which is depth 0, and
/// ends with the first that is near. A depth below 0 counts as 0; from ClusteredOctree::kMaxDepth on the
/// leaves' boxes are meant. Allocates nothing. False where the box is not finite.
bool clustersNear(const ClusteredOctree& tree, const Obb& box_in_tree, double reach, int depth);

/// The same for boxes of two trees, both at that depth.
bool clustersNear(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double reach,
                  int depth);

}  // namespace octoblisk::detail
