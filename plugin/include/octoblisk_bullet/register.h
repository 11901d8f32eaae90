// Registers ClusteredOctreeShape with a dispatcher. Call this once for each dispatcher; otherwise concave
// bodies fall through each other.
#pragma once

class btCollisionDispatcher;

namespace octoblisk {

/// Registers the algorithms of ClusteredOctreeShape for contacts and for closest points (contactTest,
/// contactPairTest), in both orders. The other shape may be
/// - any convex shape, or a ClusteredOctreeShape;
/// - a concave shape of Bullet: btBvhTriangleMeshShape (also scaled or with several materials),
///   btHeightfieldTerrainShape, btStaticPlaneShape, or a GImpact mesh;
/// - a third-party concave shape of type FAST_CONCAVE_MESH_PROXYTYPE, the type of ClusteredOctreeShape.
///   Bullet's algorithms handle its pairs with convex shapes and GImpact. It collides with no further
///   concave shape.
/// Compounds work through their children, soft bodies through Bullet. All other pairs are unchanged.
///
/// Triangles of other meshes must be counter-clockwise as seen from outside, like those of
/// ClusteredOctreeShape: contacts push to the outside. Triangles of mirrored meshes and of heightfields that
/// face inward are reversed.
///
/// The last registration of a pair of types wins. Call btGImpactCollisionAlgorithm::registerAlgorithm before
/// this function: it registers every pair with GImpact, and if it is called later, GImpact computes the
/// contacts with ClusteredOctreeShape. A GImpact shape needs updateBound() after each change, as always in
/// Bullet; otherwise it is empty. The default margin of its parts (0.01) counts only after setMargin was
/// called on the shape. GImpact compounds are left to GImpact's algorithm.
void registerAlgorithm(btCollisionDispatcher* dispatcher);

/// Whether registerAlgorithm was called on this dispatcher. Without its algorithms, moving bodies with
/// ClusteredOctreeShape fall through concave ones, and Bullet reports no error. To find out, creates and
/// deletes the algorithm of two ClusteredOctreeShapes. Does not notice a later registration of GImpact, which
/// replaces only the algorithms of pairs with GImpact.
bool isRegistered(btCollisionDispatcher* dispatcher);

}  // namespace octoblisk
