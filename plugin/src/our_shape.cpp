#include "our_shape.h"

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>
#include <typeinfo>

namespace octoblisk::detail {

const ClusteredOctreeShape* asOurShape(const btCollisionShape& shape) {
  if (shape.getShapeType() != FAST_CONCAVE_MESH_PROXYTYPE) return nullptr;
  // The class is final; a dynamic_cast costs as much as the rest of a query.
  if (typeid(shape) != typeid(ClusteredOctreeShape)) return nullptr;
  return static_cast<const ClusteredOctreeShape*>(&shape);
}

bool hasPart(const btCollisionShape& shape) {
  return anyLeaf(shape, [](const btCollisionShape& leaf) { return leaf.isConvex() || asOurShape(leaf); });
}

bool holdsOurShape(const btCollisionShape& shape) {
  return anyLeaf(shape, [](const btCollisionShape& leaf) { return asOurShape(leaf) != nullptr; });
}

btScalar breakingThreshold(const btCollisionShape& body, const ClusteredOctreeShape* part) {
  const btScalar of_body = body.getContactBreakingThreshold(gContactBreakingThreshold);
  if (!part || part == &body) return of_body;
  return std::min(of_body, part->getContactBreakingThreshold(gContactBreakingThreshold));
}

double contactReach(const ClusteredOctreeShape& shape) {
  return double(shape.getMargin()) + double(shape.getContactBreakingThreshold(gContactBreakingThreshold));
}

}  // namespace octoblisk::detail
