// What a tree looks like, through Bullet's debug drawer.
#pragma once

class btIDebugDraw;
class btTransform;
class btVector3;

namespace octoblisk {

class ClusteredOctreeShape;

/// Draws the edges of the tree's oriented boxes at a depth (the root's is 0), and of the leaves above it, of
/// a shape at `shape_in_world`: twelve lines a box. All leaves: ClusteredOctree::kMaxDepth.
void drawClusters(btIDebugDraw& drawer, const btTransform& shape_in_world, const ClusteredOctreeShape& shape,
                  int depth, const btVector3& color);

}  // namespace octoblisk
