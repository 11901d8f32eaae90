#include "octoblisk_bullet/adopt_meshes.h"

#include <BulletCollision/CollisionShapes/btMultimaterialTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "plugin/bullet_world.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;
using testing::BulletWorld;

ClusteredOctreeShape& ourShapeOf(const btCollisionObject& object) {
  return dynamic_cast<ClusteredOctreeShape&>(const_cast<btCollisionShape&>(*object.getCollisionShape()));
}

/// A hilly floor of a BVH, a smaller one, scaled, on top of it in a compound beside a box, and tori of
/// GImpact.
class AdoptMeshesTest : public ::testing::Test {
 protected:
  AdoptMeshesTest() {
    gimpact_.setLocalScaling(kScaling);
    gimpact_.updateBound();
    inner_.addChildShape(at(0, 0, 0), &scaled_);
    compound_.addChildShape(at(0, 0, 0.5), &inner_);
    compound_.addChildShape(at(1, 0, 1), &box_);
  }

  /// The bodies of the scene, with these shapes.
  static void fill(BulletWorld& world, btCollisionShape& floor, btCollisionShape& compound,
                   btCollisionShape& torus) {
    world.add(floor, 0, at(0, 0, 0)).setFriction(btScalar(0.75));
    world.add(compound, 0, at(1.5, 0, 0));
    for (int i = 0; i < 4; ++i) {
      btRigidBody& body = world.add(torus, btScalar(i + 1), at(0.7 * i - 1, 0.1 * i, 1.5 + 0.3 * i));
      body.setAngularVelocity(btVector3(1, 2, btScalar(i)));
    }
  }
  void fill(BulletWorld& world) { fill(world, floor_, compound_, gimpact_); }

  static btRigidBody& body(BulletWorld& world, int i) {
    return *btRigidBody::upcast(world->getCollisionObjectArray()[i]);
  }

  const btVector3 kScaling{btScalar(0.5), btScalar(0.75), btScalar(0.5)};
  BulletMesh hills_{*testing::waveSheet(6, 0.1, 24)}, torus_{*testing::torus(0.5, 0.2, 24, 12)};
  btBvhTriangleMeshShape floor_{hills_.view(), true};
  btScaledBvhTriangleMeshShape scaled_{&floor_, btVector3(btScalar(0.25), btScalar(0.25), 1)};
  btBoxShape box_{btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2))};
  btCompoundShape inner_, compound_;
  btGImpactMeshShape gimpact_{torus_.view()};
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

/// The oracle: the same scene, made with ClusteredOctreeShape.
TEST_F(AdoptMeshesTest, theWorldMovesAsIfItHadBeenMadeSo) {
  ClusteredOctreeShape floor(hills_.view()), small(hills_.view(), scaled_.getLocalScaling()),
      torus(torus_.view(), kScaling);
  btCompoundShape inner, compound;
  inner.addChildShape(at(0, 0, 0), &small);
  compound.addChildShape(at(0, 0, 0.5), &inner);
  compound.addChildShape(at(1, 0, 1), &box_);
  BulletWorld made, adopting;
  fill(made, floor, compound, torus);
  fill(adopting);
  adopting.step(3);  // so that there are algorithms of the former shapes
  for (int i = 2; i < 6; ++i) {
    body(adopting, i).setWorldTransform(body(made, i).getWorldTransform());
    body(adopting, i).setInterpolationWorldTransform(body(made, i).getWorldTransform());
    body(adopting, i).setLinearVelocity(body(made, i).getLinearVelocity());
    body(adopting, i).setAngularVelocity(body(made, i).getAngularVelocity());
  }
  AdoptedMeshes adopted = adoptMeshes(*adopting);
  EXPECT_EQ(adopted.replaced().size(), 3u);
  EXPECT_TRUE(adopted.left().empty());
  int touching = 0;
  for (int step = 0; step < 240; ++step) {
    made.step(1);
    adopting.step(1);
    touching += made.contactPoints() > 0;
    for (int i = 0; i < 6; ++i) {
      ASSERT_EQ(body(made, i).getWorldTransform(), body(adopting, i).getWorldTransform())
          << "body " << i << ", step " << step;
    }
  }
  EXPECT_GT(touching, 100);
}

TEST_F(AdoptMeshesTest, shapesKeepWhatUsersHaveSet) {
  int pointed_at = 0;
  floor_.setUserPointer(&pointed_at);
  floor_.setUserIndex(3);
  floor_.setUserIndex2(4);
  floor_.setMargin(btScalar(0.03125));
  hills_.view()->setScaling(btVector3(2, 1, 1));
  BulletWorld world;
  btBvhTriangleMeshShape again(hills_.view(), true);
  fill(world);
  world.add(again, 0, at(20, 0, 0));
  AdoptedMeshes adopted = adoptMeshes(*world);
  const ClusteredOctreeShape& floor = ourShapeOf(body(world, 0));
  EXPECT_EQ(floor.getUserPointer(), &pointed_at);
  EXPECT_EQ(floor.getUserIndex(), 3);
  EXPECT_EQ(floor.getUserIndex2(), 4);
  EXPECT_EQ(floor.getMargin(), btScalar(0.03125));
  EXPECT_EQ(floor.getLocalScaling(), btVector3(2, 1, 1));
  EXPECT_EQ(body(world, 0).getFriction(), btScalar(0.75));
  const ClusteredOctreeShape& same_mesh = ourShapeOf(body(world, 6));
  EXPECT_EQ(same_mesh.sharedTree(), floor.sharedTree());
  EXPECT_EQ(same_mesh.getMargin(), 0);
  EXPECT_EQ(same_mesh.getUserPointer(), nullptr);
  EXPECT_EQ(&ourShapeOf(body(world, 2)), &ourShapeOf(body(world, 3)));  // as before
  EXPECT_EQ(compound_.getChildShape(0), &inner_);
  const auto& child = dynamic_cast<const ClusteredOctreeShape&>(*inner_.getChildShape(0));
  EXPECT_EQ(child.getLocalScaling(), btVector3(btScalar(0.5), btScalar(0.25), 1));
  adopted.putBack();
}

TEST_F(AdoptMeshesTest, theInertiaIsExactUnlessTheUserHasSetIt) {
  BulletWorld world;
  fill(world);
  const btVector3 of_user(1, 2, 3);
  body(world, 3).setMassProps(2, of_user);
  body(world, 3).updateInertiaTensor();
  AdoptedMeshes adopted = adoptMeshes(*world);
  btVector3 exact;
  ourShapeOf(body(world, 2)).calculateLocalInertia(1, exact);
  EXPECT_LT((body(world, 2).getLocalInertia() - exact).length(), 1e-6 * exact.length());
  EXPECT_LT((body(world, 3).getLocalInertia() - of_user).length(), 1e-6 * of_user.length());
  btVector3 of_gimpact;
  gimpact_.calculateLocalInertia(1, of_gimpact);
  EXPECT_GT((of_gimpact - exact).length(), 1e-3 * exact.length());
  adopted.putBack();
  EXPECT_LT((body(world, 2).getLocalInertia() - of_gimpact).length(), 1e-6 * exact.length());
}

TEST_F(AdoptMeshesTest, staticBodiesBecomeDynamicWhereAsked) {
  BulletWorld world;
  fill(world);
  BulletMesh ring(*testing::torus(0.5, 0.2, 24, 12));
  btBvhTriangleMeshShape bvh(ring.view(), true);
  world.add(bvh, 0, at(-1, 1, 2)).setUserIndex(7);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btCompoundShape with_plane;
  with_plane.addChildShape(at(0, 0, 0), &bvh);
  with_plane.addChildShape(at(0, 0, 0), &plane);
  world.add(with_plane, 0, at(0, 0, -3)).setUserIndex(7);
  const btTransform start = body(world, 6).getWorldTransform();
  AdoptedMeshes adopted =
      adoptMeshes(*world, [](const btRigidBody& body) { return btScalar(body.getUserIndex() == 7 ? 2 : 0); });
  ASSERT_EQ(adopted.left().size(), 1u);
  EXPECT_EQ(adopted.left()[0].shape, &with_plane);
  EXPECT_NE(adopted.left()[0].why.find("static"), std::string::npos);
  btRigidBody* fallen = nullptr;
  for (int i = 0; i < world->getNumCollisionObjects(); ++i) {
    btRigidBody& candidate = body(world, i);
    if (candidate.getUserIndex() == 7 && !candidate.isStaticObject()) fallen = &candidate;
  }
  ASSERT_NE(fallen, nullptr);
  EXPECT_EQ(fallen->getMass(), 2);
  EXPECT_TRUE(body(world, 0).isStaticObject());
  world.step(480);
  const btScalar height = fallen->getWorldTransform().getOrigin().z();
  EXPECT_LT(height, 1);
  EXPECT_GT(height, 0);  // the hills carry it
  fallen->setWorldTransform(start);
  adopted.putBack();
  EXPECT_TRUE(fallen->isStaticObject());
  EXPECT_EQ(fallen->getCollisionShape(), &bvh);
  world.step(240);
  EXPECT_EQ(fallen->getWorldTransform(), start);
}

/// The oracle: a world in which nothing was replaced.
TEST_F(AdoptMeshesTest, puttingBackRestoresTheWorld) {
  const auto run = [](BulletWorld& world) {
    std::vector<btTransform> poses;
    for (int step = 0; step < 240; ++step) {
      world.step(1);
      for (int i = 2; i < 6; ++i) poses.push_back(body(world, i).getWorldTransform());
    }
    return poses;
  };
  std::vector<btTransform> untouched, restored;
  for (std::vector<btTransform>* poses : {&untouched, &restored}) {
    BulletWorld world;
    btGImpactCollisionAlgorithm::registerAlgorithm(&world.dispatcher());
    registerAlgorithm(&world.dispatcher());
    fill(world);
    if (poses == &restored) {
      AdoptedMeshes adopted = adoptMeshes(*world);
      adopted.putBack();
      adopted.putBack();
    }
    *poses = run(world);
  }
  EXPECT_EQ(untouched, restored);
  EXPECT_EQ(inner_.getChildShape(0), &scaled_);
}

TEST_F(AdoptMeshesTest, bodiesThatAreGoneStayAlone) {
  BulletWorld world;
  fill(world);
  btRigidBody gone(1, nullptr, &gimpact_, btVector3(1, 1, 1));
  world->addRigidBody(&gone);
  AdoptedMeshes adopted = adoptMeshes(*world);
  btCollisionShape* const adopted_shape = gone.getCollisionShape();
  world->removeRigidBody(&gone);
  adopted.putBack();
  EXPECT_EQ(gone.getCollisionShape(), adopted_shape);
  EXPECT_EQ(body(world, 2).getCollisionShape(), &gimpact_);
}

TEST_F(AdoptMeshesTest, whatIsLeftIsNamed) {
  BulletWorld world;
  fill(world);
  btMultimaterialTriangleMeshShape materials(hills_.view(), true);
  btGImpactCompoundShape pieces;
  std::vector<btScalar> corners(9, std::numeric_limits<btScalar>::quiet_NaN());
  std::vector<int> indices{0, 1, 2};
  btTriangleIndexVertexArray not_finite(1, indices.data(), 3 * sizeof(int), 3, corners.data(),
                                        3 * sizeof(btScalar));
  btGImpactMeshShape unusable(&not_finite);
  for (btCollisionShape* const shape :
       {static_cast<btCollisionShape*>(&materials), static_cast<btCollisionShape*>(&pieces),
        static_cast<btCollisionShape*>(&unusable), static_cast<btCollisionShape*>(&materials)}) {
    auto* const object = new btCollisionObject;
    object->setCollisionShape(shape);
    objects_.emplace_back(object);
  }
  for (const auto& object : objects_) world->addCollisionObject(object.get());
  AdoptedMeshes adopted = adoptMeshes(*world);
  ASSERT_EQ(adopted.left().size(), 3u);
  EXPECT_EQ(adopted.left()[0].shape, &materials);
  EXPECT_NE(adopted.left()[0].why.find("materials"), std::string::npos);
  EXPECT_EQ(adopted.left()[1].shape, &pieces);
  EXPECT_NE(adopted.left()[1].why.find("GImpactCompound"), std::string::npos);
  EXPECT_EQ(adopted.left()[2].shape, &unusable);
  EXPECT_NE(adopted.left()[2].why.find("vertex 0"), std::string::npos) << adopted.left()[2].why;
  EXPECT_EQ(adopted.replaced().size(), 3u);
  EXPECT_EQ(objects_[0]->getCollisionShape(), &materials);
  for (const auto& object : objects_) world->removeCollisionObject(object.get());
  adopted.putBack();
}

TEST_F(AdoptMeshesTest, linksOfMultibodiesCollide) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btMultiBodyConstraintSolver solver;
  btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -10));
  btCollisionObject ground;
  ground.setCollisionShape(&floor_);
  world.addCollisionObject(&ground, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::AllFilter);
  btVector3 inertia;
  gimpact_.calculateLocalInertia(1, inertia);
  btMultiBody multibody(0, 1, inertia, false, false);
  multibody.finalizeMultiDof();
  multibody.setBaseWorldTransform(at(0, 0, 1.5));
  btMultiBodyLinkCollider collider(&multibody, -1);
  collider.setCollisionShape(&gimpact_);
  collider.setWorldTransform(multibody.getBaseWorldTransform());
  world.addCollisionObject(&collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
  multibody.setBaseCollider(&collider);
  world.addMultiBody(&multibody);
  {
    AdoptedMeshes adopted = adoptMeshes(world);
    EXPECT_EQ(adopted.replaced().size(), 2u);
    for (int step = 0; step < 480; ++step) world.stepSimulation(btScalar(1) / 240, 0);
    const btScalar height = multibody.getBaseWorldTransform().getOrigin().z();
    EXPECT_GT(height, 0);
    EXPECT_LT(height, 1);
    adopted.putBack();
  }
  EXPECT_EQ(collider.getCollisionShape(), &gimpact_);
  world.removeMultiBody(&multibody);
  world.removeCollisionObject(&collider);
  world.removeCollisionObject(&ground);
}

}  // namespace
}  // namespace octoblisk
