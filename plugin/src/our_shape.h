// Whether a shape is ours or holds ours, and how far from it contacts reach.
#pragma once

#include <BulletCollision/CollisionShapes/btCompoundShape.h>

#include "octoblisk_bullet/clustered_octree_shape.h"

namespace octoblisk::detail {

/// The shape as a ClusteredOctreeShape; null if it is another shape.
const ClusteredOctreeShape* asOurShape(const btCollisionShape& shape);

/// Whether the shape, or a child of a compound, is ours or convex.
bool hasPart(const btCollisionShape& shape);

/// Whether the shape is a ClusteredOctreeShape, or a compound that contains one at any depth.
bool holdsOurShape(const btCollisionShape& shape);

/// The contact breaking threshold of a part of a body: that of the body's shape, as Bullet takes it for a new
/// manifold, but at most that of the part if it is ours.
btScalar breakingThreshold(const btCollisionShape& body, const ClusteredOctreeShape* part);

/// The distance from its triangles within which our shape has contacts.
double contactReach(const ClusteredOctreeShape& shape);

/// Whether the shape, or a child of a compound at any depth, is as asked.
template <typename Is>
bool anyLeaf(const btCollisionShape& shape, const Is& is) {
  if (!shape.isCompound()) return is(shape);
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (anyLeaf(*compound.getChildShape(i), is)) return true;
  }
  return false;
}

}  // namespace octoblisk::detail
