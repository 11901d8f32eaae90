// The box around a shape of Bullet, as an Aabb.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

/// The shape's box at a pose, margin included.
inline Aabb shapeBounds(const btCollisionShape& shape, const btTransform& pose = btTransform::getIdentity()) {
  btVector3 min, max;
  shape.getAabb(pose, min, max);
  return {fromBullet(min), fromBullet(max)};
}

}  // namespace octoblisk::detail
