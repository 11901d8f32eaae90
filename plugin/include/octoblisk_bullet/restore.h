// Restores ClusteredOctreeShape and its bodies from a .bullet file. world_importer.h does all of this; use
// these functions in other readers of such files.
#pragma once

#include <memory>

struct btCollisionShapeData;
struct btRigidBodyDoubleData;
struct btRigidBodyFloatData;
class btRigidBody;
class btStridingMeshInterface;

namespace octoblisk {

class ClusteredOctreeShape;

/// The saved shape with its scaling, margin, contact breaking threshold and setSolid. `mesh` is the mesh that
/// an importer made from the same data, with its scaling; it is copied. The tree is rebuilt with default
/// options. Null if another kind of shape was saved. Throws as the shape's constructor does.
std::unique_ptr<ClusteredOctreeShape> restoredShape(const btCollisionShapeData& saved,
                                                    const btStridingMeshInterface& mesh);

/// Restores the state of a body whose pose is already restored: mass, inertia, gravity, velocities, damping,
/// factors, friction (also anisotropic), restitution, contact stiffness and damping, the thresholds of motion
/// clamping and of contact processing, collision flags, and sleep. Bullet saves no spinning friction. If the
/// mass changes between 0 and another value, the body must not be in a world. Adding the body to a world
/// replaces its gravity by the world's, as always in Bullet.
void restoreBody(const btRigidBodyFloatData& saved, btRigidBody& body);
void restoreBody(const btRigidBodyDoubleData& saved, btRigidBody& body);

}  // namespace octoblisk
