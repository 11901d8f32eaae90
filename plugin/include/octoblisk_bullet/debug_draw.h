// Draws the boxes of a tree with Bullet's debug drawer.
#pragma once

class btIDebugDraw;
class btTransform;
class btVector3;

namespace octoblisk {

class ClusteredOctreeShape;

/// Draws the edges of the tree's oriented boxes at a depth (the root's box has depth 0) and of the leaf boxes
/// above that depth, for a shape at `shape_in_world`. Draws twelve lines per box. Pass
/// ClusteredOctree::kMaxDepth to draw all leaves.
void drawClusters(btIDebugDraw& drawer, const btTransform& shape_in_world, const ClusteredOctreeShape& shape,
                  int depth, const btVector3& color);

}  // namespace octoblisk
