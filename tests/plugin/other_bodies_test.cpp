// Cloth, ghosts, multibodies, rays and sweeps against the plugin's shape.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <gtest/gtest.h>

#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletWorld;

/// A world with gravity. Its collision objects are removed at the end.
template <typename World>
void settle(World& world, int steps) {
  for (int i = 0; i < steps; ++i) world.stepSimulation(btScalar(1.0 / 240.0), 0);
}

template <typename Broadphase>
void clothRestsOnOurs() {
  auto floor = shapeOver(testing::waveSheet(4, 0.0, 16));
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  registerAlgorithm(&dispatcher);
  Broadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  world.getWorldInfo().m_gravity = world.getGravity();
  btRigidBody ground(0, nullptr, &floor);
  world.addRigidBody(&ground);
  btSoftBody* cloth = btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), toBullet(Vec3(-1, -1, 1)),
                                                     toBullet(Vec3(1, -1, 1)), toBullet(Vec3(-1, 1, 1)),
                                                     toBullet(Vec3(1, 1, 1)), 9, 9, 0, true);
  cloth->setTotalMass(1);
  world.addSoftBody(cloth);
  settle(world, 480);
  EXPECT_EQ(cloth->m_nodes.size(), 81);
  for (int n = 0; n < cloth->m_nodes.size(); ++n) {
    EXPECT_GT(double(cloth->m_nodes[n].m_x.z()), -0.1);
    EXPECT_LT(double(cloth->m_nodes[n].m_x.z()), 0.5);  // it fell
  }
  world.removeSoftBody(cloth);
  delete cloth;
  world.removeRigidBody(&ground);
}

TEST(OtherBodies, clothRestsOnOurs) { clothRestsOnOurs<btDbvtBroadphase>(); }
TEST(OtherBodies, clothRestsOnOursInOurBroadphase) { clothRestsOnOurs<ClusteredOctreeBroadphase>(); }

TEST(OtherBodies, ghostsSeeOurs) {
  auto torus = shapeOver(testing::torus(2, 0.7, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  BulletWorld world;
  btGhostPairCallback callback;
  world->getPairCache()->setInternalGhostPairCallback(&callback);
  world.add(torus, 0, at(0, 0, 0));
  btPairCachingGhostObject ghost;
  ghost.setCollisionShape(&sphere);
  ghost.setWorldTransform(at(2, 0, 1));
  ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
  world->addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, -1);
  world.step(1);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  btBroadphasePairArray& pairs = ghost.getOverlappingPairCache()->getOverlappingPairArray();
  ASSERT_EQ(pairs.size(), 1);
  // The ghost's own cache knows the pair. The world's cache has its algorithm.
  btBroadphasePair* pair = world->getPairCache()->findPair(pairs[0].m_pProxy0, pairs[0].m_pProxy1);
  ASSERT_TRUE(pair && pair->m_algorithm);
  btManifoldArray manifolds;
  pair->m_algorithm->getAllContactManifolds(manifolds);
  int contacts = 0;
  for (int m = 0; m < manifolds.size(); ++m) contacts += manifolds[m]->getNumContacts();
  EXPECT_GT(contacts, 0);
  world->removeCollisionObject(&ghost);
}

template <typename Broadphase>
void aMultibodyRestsOnOurs() {
  auto floor = shapeOver(testing::waveSheet(4, 0.0, 16));
  auto torus = shapeOver(testing::torus(0.6, 0.25, 24, 12));
  btBoxShape box(toBullet(Vec3(0.4, 0.3, 0.2)));
  for (btCollisionShape* shape :
       {static_cast<btCollisionShape*>(&box), static_cast<btCollisionShape*>(&torus)}) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    registerAlgorithm(&dispatcher);
    Broadphase broadphase;
    btMultiBodyConstraintSolver solver;
    btMultiBodyDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
    world.setGravity(btVector3(0, 0, btScalar(-9.81)));
    btRigidBody ground(0, nullptr, &floor);
    world.addRigidBody(&ground);
    btVector3 inertia;
    shape->calculateLocalInertia(1, inertia);
    btMultiBody body(0, 1, inertia, false, false);
    body.finalizeMultiDof();
    body.setBasePos(toBullet(Vec3(0.1, 0.2, 0.8)));
    btMultiBodyLinkCollider collider(&body, -1);
    collider.setCollisionShape(shape);
    collider.setWorldTransform(at(0.1, 0.2, 0.8));
    body.setBaseCollider(&collider);
    world.addMultiBody(&body);
    world.addCollisionObject(&collider, btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter);
    settle(world, 480);
    EXPECT_NEAR(double(body.getBasePos().z()), shape == &box ? 0.2 : 0.25, 0.03);
    world.removeCollisionObject(&collider);
    world.removeMultiBody(&body);
    world.removeRigidBody(&ground);
  }
}

TEST(OtherBodies, aMultibodyRestsOnOurs) { aMultibodyRestsOnOurs<btDbvtBroadphase>(); }
TEST(OtherBodies, aMultibodyRestsOnOursInOurBroadphase) {
  aMultibodyRestsOnOurs<ClusteredOctreeBroadphase>();
}

TEST(OtherBodies, raysAndSweepsHitOurs) {
  auto floor = shapeOver(testing::waveSheet(4, 0.0, 16));
  btSphereShape sphere(btScalar(0.5));
  BulletWorld world;
  btRigidBody& ground = world.add(floor, 0, at(0, 0, 0));
  const btVector3 from(btScalar(0.1), btScalar(0.2), 2), to(btScalar(0.1), btScalar(0.2), -2);
  btCollisionWorld::ClosestRayResultCallback ray(from, to);
  world->rayTest(from, to, ray);
  ASSERT_EQ(ray.m_collisionObject, &ground);
  EXPECT_NEAR(double(ray.m_closestHitFraction), 0.5, 1e-5);
  btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
  world->convexSweepTest(&sphere, btTransform(btMatrix3x3::getIdentity(), from),
                         btTransform(btMatrix3x3::getIdentity(), to), sweep);
  ASSERT_EQ(sweep.m_hitCollisionObject, &ground);
  EXPECT_NEAR(double(sweep.m_closestHitFraction), 1.5 / 4.0, 5e-3);
}

}  // namespace
}  // namespace octoblisk
