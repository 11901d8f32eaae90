// All contacts in a Bullet world, one after the other: who, with which triangle of which blade, where, how
// deep.
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
  /// Part and index of the triangle of a mesh; of a compound's convex child -1 and its number; else -1, -1.
  TriangleId triangle = {-1, -1};
  int blade = 0;                         ///< by the body's table; 0 where it has none
  btVector3 point = btVector3(0, 0, 0);  ///< on its surface, in the world
};

/// A point of a manifold as it is reported: of two bodies A is that which was added to the world first.
struct ReportedContact {
  ContactBody a;
  ContactBody b;
  btVector3 normal =
      btVector3(0, 0, 0);  ///< unit, in the world, from B to A: moving A along it parts the two
  btScalar distance = 0;   ///< > 0 apart, <= 0 touching or as deep; world units
};

/// The blades of a body with ClusteredOctreeShape: for each triangle of the shape's mesh, all parts one after
/// the other, 1 and more, or 0 where it belongs to none. The numbers are the caller's and must outlive a
/// report.
struct BladeTable {
  const btCollisionObject* object = nullptr;
  std::span<const int> blade_of_triangle;
};

/// Replaces `found` by the points of all manifolds of a dispatcher that are no farther apart than `up_to`, in
/// world units: as the last performDiscreteCollisionDetection, or step, found them. They are in the order of
/// their bodies' adding to the world, then of triangles, then of depth and place: the same however the
/// broadphase and the manifolds are sorted. A manifold holds a few points of each patch of contact and what
/// Bullet keeps from steps before; for all pairs of triangles ask octoblisk/contacts.h.
///
/// Bodies must be in a world. Throws std::invalid_argument where a table's body has another shape, or its
/// mesh another number of triangles. Where `found` has the room, allocates nothing.
void reportContacts(btDispatcher& dispatcher, std::vector<ReportedContact>& found,
                    std::span<const BladeTable> blades = {}, btScalar up_to = btScalar(BT_LARGE_FLOAT));

}  // namespace octoblisk
