// Our shape, and the bodies that have it, out of a .bullet file. world_importer.h does all of it; this is for
// other readers of such files.
#pragma once

#include <memory>

struct btCollisionShapeData;
struct btRigidBodyDoubleData;
struct btRigidBodyFloatData;
class btRigidBody;
class btStridingMeshInterface;

namespace octoblisk {

class ClusteredOctreeShape;

/// The shape that was saved, with its scaling, margin and contact breaking threshold. `mesh`: what an
/// importer made of the same data's mesh, the scaling included; it is copied. The tree is built anew, with
/// default options. Null where another shape was saved. Throws as the shape's constructor.
std::unique_ptr<ClusteredOctreeShape> restoredShape(const btCollisionShapeData& saved,
                                                    const btStridingMeshInterface& mesh);

/// Gives a body, which is where it was saved, the rest of what moves it: mass, inertia, velocities, damping,
/// factors, whether it is kinematic, whether it sleeps and when it will. A body whose mass changes between 0
/// and others must not be in a world.
void restoreBody(const btRigidBodyFloatData& saved, btRigidBody& body);
void restoreBody(const btRigidBodyDoubleData& saved, btRigidBody& body);

}  // namespace octoblisk
