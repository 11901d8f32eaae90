#include "body_parts.h"

#include <typeinfo>

namespace octoblisk::detail {

const ClusteredOctreeShape* asClusters(const btCollisionShape& shape) {
  if (shape.getShapeType() != FAST_CONCAVE_MESH_PROXYTYPE) return nullptr;
  // The class is final; a dynamic_cast costs as much as the rest of a query.
  if (typeid(shape) != typeid(ClusteredOctreeShape)) return nullptr;
  return static_cast<const ClusteredOctreeShape*>(&shape);
}

bool hasPart(const btCollisionShape& shape) {
  if (!shape.isCompound()) return shape.isConvex() || asClusters(shape);
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (hasPart(*compound.getChildShape(i))) return true;
  }
  return false;
}

bool holdsClusters(const btCollisionShape& shape) {
  if (!shape.isCompound()) return asClusters(shape) != nullptr;
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    if (holdsClusters(*compound.getChildShape(i))) return true;
  }
  return false;
}

Pose poseOfChild(const btCompoundShape& compound, int child) {
  const Pose pose = fromBullet(compound.getChildTransform(child));
  return {Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix(), pose.translation};
}

CoreCorners& cornersOfThread() {
  thread_local CoreCorners corners;
  return corners;
}

}  // namespace octoblisk::detail
