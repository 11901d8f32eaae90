// Bad use gives a clear exception at construction, or no contact, and nothing worse.
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <vector>

#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/register.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"
#include "shared/message_of.h"

namespace octoblisk {
namespace {

using testing::messageOf;
using testing::PairReport;

TEST(BadUse, moreThanBulletCanNumber) {
  EXPECT_EQ(messageOf([] { TriangleParts(std::vector<std::uint32_t>(1024, 0), 5); }), "accepted");
  EXPECT_EQ(messageOf([] { TriangleParts(std::vector<std::uint32_t>(1025, 0), 5); }),
            "the mesh has 1025 parts; Bullet numbers at most 1024");
  constexpr std::uint32_t kMaxTriangles = 1u << 21;
  EXPECT_EQ(messageOf([] { TriangleParts({0, kMaxTriangles}, 2 * kMaxTriangles); }), "accepted");
  EXPECT_EQ(messageOf([] {
              TriangleParts({0, 1}, kMaxTriangles + 2);
            }),
            "part 1 of the mesh has 2097153 triangles; Bullet numbers at most 2097152 per part");
  const TriangleParts most({0, kMaxTriangles}, 2 * kMaxTriangles);
  EXPECT_EQ(most.id(2 * kMaxTriangles - 1).part, 1);
  EXPECT_EQ(most.id(2 * kMaxTriangles - 1).index, int(kMaxTriangles) - 1);
}

TEST(BadUse, partsThatAreNone) {
  const auto tree = treeOver(testing::torus(2, 0.7, 12, 6));
  const auto with = [&](std::vector<std::uint32_t> begin) {
    return messageOf([&] { const ClusteredOctreeShape shape(tree, std::move(begin)); });
  };
  EXPECT_EQ(with({0, 10, 144}), "accepted");  // parts may be empty
  EXPECT_EQ(with({}), "the first part of a mesh must begin with triangle 0");
  EXPECT_EQ(with({1}), "the first part of a mesh must begin with triangle 0");
  EXPECT_EQ(with({0, 10, 9}), "part 1 of the mesh begins with triangle 10 and ends before 9");
  EXPECT_EQ(with({0, 145}), "part 1 of the mesh begins with triangle 145 and ends before 144");
}

TEST(BadUse, tooManyPartsInAnInterface) {
  testing::BulletMesh triangle(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  btTriangleIndexVertexArray many;
  for (int part = 0; part < 1025; ++part) many.addIndexedMesh(triangle.view()->getIndexedMeshArray()[0]);
  EXPECT_EQ(messageOf([&] { const ClusteredOctreeShape shape(&many); }),
            "the mesh has 1025 parts; Bullet numbers at most 1024");
}

TEST(BadUse, aMissingRegistrationIsReported) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  EXPECT_FALSE(isRegistered(&dispatcher));
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  EXPECT_FALSE(isRegistered(&dispatcher));
  {  // without registration, bodies with the plugin's shape do not meet
    ClusteredOctreeShape torus(treeOver(testing::torus(2, 0.7, 24, 12)));
    ClusteredOctreeBroadphase broadphase;
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btCollisionObject one, other;
    one.setCollisionShape(&torus);
    other.setCollisionShape(&torus);
    world.addCollisionObject(&one);
    world.addCollisionObject(&other);
    EXPECT_DEBUG_DEATH(world.performDiscreteCollisionDetection(), "registerAlgorithm was not called");
#ifdef NDEBUG
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
#endif
    registerAlgorithm(&dispatcher);
    EXPECT_TRUE(isRegistered(&dispatcher));
    world.getPairCache()->cleanProxyFromPairs(one.getBroadphaseHandle(), &dispatcher);
    world.performDiscreteCollisionDetection();
    EXPECT_GT(dispatcher.getNumManifolds(), 0);
    world.removeCollisionObject(&one);
    world.removeCollisionObject(&other);
  }
}

TEST(BadUse, anExhaustedContactPoolDropsContacts) {
  btDefaultCollisionConstructionInfo pools;
  pools.m_defaultMaxPersistentManifoldPoolSize = 3;
  btDefaultCollisionConfiguration configuration(pools);
  btCollisionDispatcher dispatcher(&configuration);
  dispatcher.setDispatcherFlags(btCollisionDispatcher::CD_DISABLE_CONTACTPOOL_DYNAMIC_ALLOCATION);
  registerAlgorithm(&dispatcher);
  btDbvtBroadphase broadphase;
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  ClusteredOctreeShape torus(treeOver(testing::torus(2, 0.7, 24, 12)));
  std::array<btCollisionObject, 4> rings;  // all at one position: six pairs with several patches each
  for (std::size_t i = 0; i < rings.size(); ++i) {
    rings[i].setCollisionShape(&torus);
    btTransform pose(btQuaternion(btVector3(1, 0, 0), btScalar(0.4) * btScalar(i)));
    rings[i].setWorldTransform(pose);
    world.addCollisionObject(&rings[i]);
  }
  for (int step = 0; step < 3; ++step) world.performDiscreteCollisionDetection();
  EXPECT_EQ(dispatcher.getNumManifolds(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_GT(dispatcher.getManifoldByIndexInternal(i)->getNumContacts(), 0);
  world.removeCollisionObject(&rings[0]);  // pairs without manifolds get its manifolds
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(dispatcher.getNumManifolds(), 3);
  for (std::size_t i = 1; i < rings.size(); ++i) world.removeCollisionObject(&rings[i]);
  EXPECT_EQ(dispatcher.getNumManifolds(), 0);
}

/// A floor of one triangle whose callback may throw.
class FloorThatThrows final : public btConcaveShape {
 public:
  FloorThatThrows() { m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE; }

  bool throws = true;

  void processAllTriangles(btTriangleCallback* callback, const btVector3&, const btVector3&) const override {
    if (throws) throw std::runtime_error("no triangles");
    btVector3 corners[] = {{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
    callback->processTriangle(corners, 0, 0);
  }
  void getAabb(const btTransform&, btVector3& low, btVector3& high) const override {
    low = btVector3(-9, -9, -1);
    high = btVector3(9, 9, 1);
  }
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return scaling_; }
  void calculateLocalInertia(btScalar, btVector3& inertia) const override { inertia.setZero(); }
  const char* getName() const override { return "FloorThatThrows"; }

 private:
  btVector3 scaling_ = btVector3(1, 1, 1);
};

TEST(BadUse, aQueryThatThrowsIsRepeated) {
  ClusteredOctreeShape box(treeOver(testing::boxMesh({1, 1, 1})));
  FloorThatThrows floor;
  btCollisionObject one, other;
  one.setCollisionShape(&box);
  one.setWorldTransform(testing::at(0, 0, 1));
  other.setCollisionShape(&floor);
  testing::BulletWorld world;
  world->addCollisionObject(&one, 1, -1);
  world->addCollisionObject(&other, 1, -1);
  EXPECT_THROW(world->performDiscreteCollisionDetection(), std::runtime_error);
  floor.throws = false;
  world->performDiscreteCollisionDetection();
  ASSERT_EQ(world.dispatcher().getNumManifolds(), 1);
  EXPECT_EQ(world.dispatcher().getManifoldByIndexInternal(0)->getNumContacts(), 4);
  world->removeCollisionObject(&one);
  world->removeCollisionObject(&other);
}

TEST(BadUse, shapesExchangedInALiveBody) {
  ClusteredOctreeShape torus(treeOver(testing::torus(2, 0.7, 24, 12)));
  btBoxShape box(btVector3(3, 3, btScalar(0.5)));
  btSphereShape ball(2);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  testing::BulletMesh mesh(*testing::torus(2, 0.7, 12, 8));
  btBvhTriangleMeshShape bvh(mesh.view(), true);
  btCompoundShape compound;
  compound.addChildShape(btTransform::getIdentity(), &ball);
  btCollisionShape* const shapes[] = {&box, &ball, &compound, &bvh, &plane, &torus};
  std::size_t exchanges = 0, touching = 0;
  for (btCollisionShape* const first : shapes) {  // the pair's algorithm is made for the torus and this shape
    if (first == &compound) continue;             // Bullet's algorithm does not survive an exchange
    for (btCollisionShape* const other : shapes) {
      for (btCollisionShape* const next : shapes) {
        testing::BulletWorld world;
        btCollisionObject one, two;
        one.setCollisionShape(&torus);
        two.setCollisionShape(first);
        two.setWorldTransform(testing::at(0.1, 0.2, 0.3));
        world->addCollisionObject(&one, 1, -1);
        world->addCollisionObject(&two, 1, -1);
        world->performDiscreteCollisionDetection();
        // The pair keeps the algorithm of torus and `first`.
        for (btCollisionShape* const shape : {other, next}) {
          one.setCollisionShape(shape);
          two.setCollisionShape(&torus);
          world->performDiscreteCollisionDetection();
          one.setCollisionShape(&torus);
          two.setCollisionShape(shape);
          world->performDiscreteCollisionDetection();
          ++exchanges;
          touching += world.contactPoints() > 0;
        }
        world->removeCollisionObject(&one);
        world->removeCollisionObject(&two);
        EXPECT_EQ(world.dispatcher().getNumManifolds(), 0);
      }
    }
  }
  EXPECT_GT(exchanges, 300u);
  EXPECT_GT(touching, exchanges / 3);
}

TEST(BadUse, posesThatAreNoneTouchNothing) {
  ClusteredOctreeShape torus(treeOver(testing::torus(2, 0.7, 24, 12)));
  btSphereShape ball(btScalar(0.5));
  testing::BulletWorld world;
  btCollisionObject ring, other_ring, sphere;
  ring.setCollisionShape(&torus);
  other_ring.setCollisionShape(&torus);
  sphere.setCollisionShape(&ball);
  const auto contactsAt = [&](btCollisionObject& other, const btTransform& pose) {
    other.setWorldTransform(pose);
    PairReport report;
    world->contactPairTest(&ring, &other, report);
    return report.points.size();
  };
  const btTransform touching = testing::at(2, 0, 0.5);
  EXPECT_GT(contactsAt(sphere, touching), 0u);
  EXPECT_GT(contactsAt(other_ring, touching), 0u);
  for (const btScalar bad :
       {std::numeric_limits<btScalar>::quiet_NaN(), std::numeric_limits<btScalar>::infinity()}) {
    btTransform moved = touching, turned = touching;
    moved.getOrigin().setY(bad);
    turned.getBasis()[1].setX(bad);
    for (btCollisionObject* other : {&sphere, &other_ring}) {
      EXPECT_EQ(contactsAt(*other, moved), 0u);
      EXPECT_EQ(contactsAt(*other, turned), 0u);
    }
    btTransform from = testing::at(2, 0, 3), to = testing::at(2, 0, -3);
    btCollisionWorld::ClosestRayResultCallback good(from.getOrigin(), to.getOrigin());
    btCollisionWorld::rayTestSingle(from, to, &ring, &torus, ring.getWorldTransform(), good);
    EXPECT_TRUE(good.hasHit());
    to.getOrigin().setX(bad);
    btCollisionWorld::ClosestRayResultCallback ray(from.getOrigin(), to.getOrigin());
    btCollisionWorld::rayTestSingle(from, to, &ring, &torus, ring.getWorldTransform(), ray);
    EXPECT_FALSE(ray.hasHit());
    btCollisionWorld::ClosestConvexResultCallback sweep(from.getOrigin(), to.getOrigin());
    btCollisionWorld::objectQuerySingle(&ball, from, to, &ring, &torus, ring.getWorldTransform(), sweep, 0);
    EXPECT_FALSE(sweep.hasHit());
  }
}

}  // namespace
}  // namespace octoblisk
