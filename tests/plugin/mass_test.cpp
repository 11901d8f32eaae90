// Tests the inertia of the plugin's shape, and that its bodies turn like solids.
#include <gtest/gtest.h>

#include "octoblisk/mass_properties.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

void expectNear(const btVector3& found, const Vec3& expected, double relative = 1e-6) {
  EXPECT_LT((fromBullet(found) - expected).norm(), relative * expected.norm())
      << fromBullet(found).transpose() << " for " << expected.transpose();
}

btVector3 inertiaOf(const btCollisionShape& shape, double mass) {
  btVector3 inertia;
  shape.calculateLocalInertia(btScalar(mass), inertia);
  return inertia;
}

TEST(Mass, inertiaOfAClosedMeshIsThatOfTheSolid) {
  const Vec3 half(1, 2, 3);
  const SharedMesh box = testing::boxMesh(half);
  expectNear(inertiaOf(shapeOver(box), 6.0), Vec3(26, 20, 10));
  // The inertia is about the origin, wherever the centre of mass is.
  const SharedMesh beside = testing::moved(*box, {Mat3::Identity(), Vec3(10, 0, 0)});
  expectNear(inertiaOf(shapeOver(beside), 6.0), Vec3(26, 620, 610));
  const double major = 3.0, minor = 1.0;
  expectNear(inertiaOf(shapeOver(testing::torus(major, minor, 200, 100)), 2.0),
             Vec3(2 * 5.125, 2 * 5.125, 2 * 9.75), 2e-3);
}

TEST(Mass, inertiaOfAnOpenMeshIsThatOfItsBox) {
  const SharedMesh box = testing::firstTriangles(*testing::boxMesh({1, 2, 3}), 11);
  EXPECT_FALSE(shapeOver(box).massProperties().is_solid);
  expectNear(inertiaOf(shapeOver(box), 6.0), Vec3(26, 20, 10));
}

TEST(Mass, inertiaFollowsTheScaling) {
  ClusteredOctreeShape shape = shapeOver(testing::boxMesh({1, 1, 1}));
  shape.setLocalScaling(btVector3(-1, 2, 3));
  EXPECT_TRUE(shape.massProperties().is_solid);
  EXPECT_NEAR(shape.massProperties().volume, 48.0, 1e-9);
  expectNear(inertiaOf(shape, 6.0), Vec3(26, 20, 10));
}

TEST(Mass, principalAxisTransform) {
  std::mt19937_64 random(71);
  const Pose pose = testing::randomPose(random, 5.0);
  const ClusteredOctreeShape shape = shapeOver(testing::moved(*testing::boxMesh({3, 2, 1}), pose));
  btTransform principal;
  btVector3 inertia;
  shape.calculatePrincipalAxisTransform(btScalar(6.0), principal, inertia);
  expectNear(inertia, Vec3(10, 20, 26));
  EXPECT_LT((fromBullet(principal.getOrigin()) - pose.translation).norm(), 1e-5);
  const Mat3 along = fromBullet(principal.getBasis()).transpose() * pose.rotation;
  EXPECT_LT((along.cwiseAbs() - Mat3::Identity()).norm(), 1e-5);
}

TEST(Mass, aCompoundAtThePrincipalFrameSpinsSteadily) {
  // Without forces, a solid that turns about a principal axis keeps doing so, with its centre of mass at
  // rest. With the inertia about the mesh's skew axes it would not.
  std::mt19937_64 random(72);
  const Pose pose = testing::randomPose(random, 1.0);
  ClusteredOctreeShape shape = shapeOver(testing::moved(*testing::boxMesh({3, 2, 1}), pose));
  btTransform principal;
  btVector3 inertia;
  shape.calculatePrincipalAxisTransform(1, principal, inertia);
  btCompoundShape compound;
  compound.addChildShape(principal.inverse(), &shape);
  testing::BulletWorld world;
  btRigidBody& body = world.add(compound, 1, principal);
  body.setMassProps(1, inertia);
  body.setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
  body.updateInertiaTensor();
  body.setGravity(btVector3(0, 0, 0));
  body.setDamping(0, 0);
  const btVector3 axis = principal.getBasis().getColumn(2);
  body.setAngularVelocity(axis * 2);
  world.step(240);
  EXPECT_LT((fromBullet(body.getAngularVelocity()) - fromBullet(axis * 2)).norm(), 1e-3);
  EXPECT_LT((fromBullet(body.getWorldTransform().getOrigin()) - pose.translation).norm(), 1e-4);
  // The mesh is where the shape alone would be, so its centre stays.
  const btTransform mesh_in_world = body.getWorldTransform() * compound.getChildTransform(0);
  EXPECT_LT((fromBullet(mesh_in_world * toBullet(pose.translation)) - pose.translation).norm(), 1e-4);
}

}  // namespace
}  // namespace octoblisk
