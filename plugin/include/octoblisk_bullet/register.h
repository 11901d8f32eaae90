// Makes a dispatcher know our shape: one line in a user's program.
#pragma once

class btCollisionDispatcher;

namespace octoblisk {

/// Registers the algorithms of ClusteredOctreeShape for contacts and for closest points (contactTest,
/// contactPairTest), in both orders, with every convex shape, with itself, and with Bullet's concave shapes:
/// btBvhTriangleMeshShape, scaled or of many materials, btHeightfieldTerrainShape, btStaticPlaneShape,
/// GImpact meshes, and whoever else's concave shape has the type FAST_CONCAVE_MESH_PROXYTYPE, which is ours.
/// Compounds work through their children, soft bodies through Bullet. All other pairs stay as they are; of
/// that type a shape that is not ours meets convex shapes and GImpact through Bullet, and no other concave
/// one but ours.
///
/// The triangles of other meshes face outward, counter-clockwise, as ours: they push out of that side. Those
/// of mirrored meshes and of heightfields, which do not, are turned.
///
/// The last registration of a pair wins. btGImpactCollisionAlgorithm::registerAlgorithm takes every pair with
/// GImpact: called after this, contacts of GImpact with our shape are its own; call it first. A GImpact shape
/// needs updateBound() after each change, as ever, or it is empty; its parts' default margin of 0.01 counts
/// only once setMargin was called on the shape. GImpact compounds are left to GImpact's algorithm.
void registerAlgorithm(btCollisionDispatcher* dispatcher);

/// Whether registerAlgorithm was called on this dispatcher, and no later registration replaced its
/// algorithms. Without it our moving bodies fall through concave ones, and Bullet reports nothing. Creates
/// and deletes the algorithm of two small meshes to find out.
bool isRegistered(btCollisionDispatcher* dispatcher);

}  // namespace octoblisk
