// Lists the manifold points of a Bullet world: the bodies, the triangles and their blades, the positions and
// the depths.
#pragma once

#include <LinearMath/btVector3.h>

#include <span>
#include <vector>

#include "octoblisk_bullet/triangle_parts.h"

class btCollisionObject;
class btDispatcher;

namespace octoblisk {

/// One body of a contact.
struct ContactBody {
  const btCollisionObject* object = nullptr;
  /// Part and index of a triangle of a mesh. For a convex child of a compound: -1 and the child's number.
  /// Otherwise -1, -1.
  TriangleId triangle = {-1, -1};
  int blade = 0;  ///< from the body's table; 0 if it has none
  /// On the outside of the body's margin, in the world. For a body that is inside a solid, Bullet computes
  /// one of the two points from the other, the normal and the depth, so it may be off the surface.
  btVector3 point = btVector3(0, 0, 0);
};

/// A manifold point as reported. A is the body with the lower broadphase id. With btDbvtBroadphase and
/// ClusteredOctreeBroadphase, that is the body whose proxy was made first. A proxy is made when a body is
/// added to the world, and again by refreshBroadphaseProxy.
struct ReportedContact {
  ContactBody a;
  ContactBody b;
  btVector3 normal =
      btVector3(0, 0, 0);  ///< unit, in the world, from B to A: moving A along it separates the bodies
  btScalar distance = 0;   ///< between the margins, world units; > 0: clearance; <= 0: touching, or -depth
};

/// Assigns blade numbers to the triangles of a body with ClusteredOctreeShape. `blade_of_triangle` has one
/// number per triangle of the shape's mesh, all parts in sequence: 1 or more, or 0 for a triangle that
/// belongs to no blade. The caller owns the numbers, which must outlive the report.
struct BladeTable {
  const btCollisionObject* object = nullptr;
  std::span<const int> blade_of_triangle;
};

/// Replaces `found` with the points of a dispatcher's manifolds whose distance is at most `up_to`, in world
/// units. The points are those of the last performDiscreteCollisionDetection or step. They are sorted by the
/// broadphase ids of the bodies, then by triangle, depth and position, so the order does not depend on how
/// the broadphase sorts pairs. A manifold holds a few points of each contact patch, and points that Bullet
/// keeps from earlier steps. A distance is computed from the two points, because the
/// manifold's own distance is 0 while two bodies bounce. For all triangle pairs, use octoblisk/contacts.h.
///
/// Bodies must be in a world. Throws std::invalid_argument if a table's body is null, has another kind of
/// shape, or has a mesh with another number of triangles. Allocates nothing if the capacity of `found`
/// suffices.
void reportContacts(btDispatcher& dispatcher, std::vector<ReportedContact>& found,
                    std::span<const BladeTable> blades = {}, btScalar up_to = btScalar(BT_LARGE_FLOAT));

}  // namespace octoblisk
