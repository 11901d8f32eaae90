// Tests what is known about a convex shape of Bullet.
#include "bullet_convex.h"

#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <gtest/gtest.h>

namespace octoblisk {
namespace {

TEST(ConvexCore, forgetsTheRimsOfAnotherShape) {
  detail::ConvexCore core;
  core.update(btCylinderShapeZ(btVector3(1, 1, 1)));
  EXPECT_TRUE(core.hasFeet());
  core.update(btSphereShape(1));
  EXPECT_FALSE(core.hasFeet());
}

}  // namespace
}  // namespace octoblisk
