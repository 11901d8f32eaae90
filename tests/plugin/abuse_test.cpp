// Tests operations that Bullet's own shapes survive: exchanging, scaling and refitting shapes, removing and
// deleting bodies, queries in callbacks, full pools. The worlds run, with both broadphases.
#include <LinearMath/btPoolAllocator.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "mesh_algorithm.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;
using testing::PairReport;

/// A world that deletes its remaining bodies. Expects that nothing else remains.
template <typename Broadphase>
class World {
 public:
  explicit World(const btDefaultCollisionConstructionInfo& pools = {}) : configuration_(pools) {
    registerAlgorithm(&dispatcher_);
    world_.setGravity(btVector3(0, 0, btScalar(-9.81)));
  }
  ~World() {
    while (!bodies_.empty()) remove(*bodies_.back());
    EXPECT_EQ(world_.getPairCache()->getNumOverlappingPairs(), 0);
    EXPECT_EQ(dispatcher_.getNumManifolds(), 0);
    EXPECT_EQ(configuration_.getPersistentManifoldPool()->getUsedCount(), 0);
    EXPECT_EQ(configuration_.getCollisionAlgorithmPool()->getUsedCount(), 0);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  btRigidBody& add(btCollisionShape& shape, double mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(btScalar(mass), inertia);
    bodies_.push_back(std::make_unique<btRigidBody>(btScalar(mass), nullptr, &shape, inertia));
    bodies_.back()->setWorldTransform(pose);
    bodies_.back()->setInterpolationWorldTransform(pose);
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }
  /// Removes the body from the world and deletes it.
  void remove(const btCollisionObject& body) {
    const auto found = std::ranges::find(bodies_, &body, [](const auto& kept) { return kept.get(); });
    ASSERT_NE(found, bodies_.end());
    world_.removeRigidBody(found->get());
    bodies_.erase(found);
  }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) world_.stepSimulation(btScalar(1.0 / 240.0), 0);
  }
  std::vector<const btPersistentManifold*> touching() {
    std::vector<const btPersistentManifold*> found;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold* manifold = dispatcher_.getManifoldByIndexInternal(m);
      if (manifold->getNumContacts() > 0) found.push_back(manifold);
    }
    return found;
  }
  bool touches(const btCollisionObject& body) {
    return std::ranges::any_of(touching(), [&](const btPersistentManifold* manifold) {
      return manifold->getBody0() == &body || manifold->getBody1() == &body;
    });
  }
  btCollisionAlgorithm* algorithmOf(btCollisionObject& a, btCollisionObject& b) {
    const btBroadphasePair* pair =
        world_.getPairCache()->findPair(a.getBroadphaseHandle(), b.getBroadphaseHandle());
    return pair ? pair->m_algorithm : nullptr;
  }
  std::vector<std::unique_ptr<btRigidBody>>& bodies() { return bodies_; }
  btCollisionDispatcher& dispatcher() { return dispatcher_; }
  Broadphase& broadphase() { return broadphase_; }
  btDiscreteDynamicsWorld* operator->() { return &world_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  Broadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

/// While it exists, the world calls it in the middle of each step.
class Tick {
 public:
  Tick(btDynamicsWorld& world, bool before_the_step, std::function<void()> action)
      : world_(world), before_(before_the_step), action_(std::move(action)) {
    world_.setInternalTickCallback(call, this, before_);
  }
  ~Tick() { world_.setInternalTickCallback(nullptr, nullptr, before_); }
  Tick(const Tick&) = delete;
  Tick& operator=(const Tick&) = delete;

 private:
  static void call(btDynamicsWorld* world, btScalar) {
    static_cast<Tick*>(world->getWorldUserInfo())->action_();
  }

  btDynamicsWorld& world_;
  bool before_;
  std::function<void()> action_;
};

/// Sets Bullet's global contact callbacks while it exists.
struct ContactCallbacks {
  ContactCallbacks(ContactAddedCallback added, ContactProcessedCallback processed,
                   ContactDestroyedCallback destroyed = nullptr) {
    gContactAddedCallback = added;
    gContactProcessedCallback = processed;
    gContactDestroyedCallback = destroyed;
  }
  ~ContactCallbacks() {
    gContactAddedCallback = nullptr;
    gContactProcessedCallback = nullptr;
    gContactDestroyedCallback = nullptr;
  }
};

/// Positions on a floor, far enough apart that bodies have no pairs with one another.
btTransform lying(int i) { return at(3.0 * (i % 4) - 4.5, 3.0 * (i / 4 % 4) - 4.5, 0.3); }

testing::SharedMesh floorMesh() { return testing::waveSheet(6, 0.0, 12); }

template <typename Broadphase>
class Abuse : public ::testing::Test {
 protected:
  /// Adds rings on a floor. Some are children of compounds.
  void addRings(World<Broadphase>& world, int count) {
    world.add(floor_, 0, at(0, 0, 0));
    for (int i = 0; i < count; ++i) world.add(i % 3 == 2 ? held_shape() : ring_, 1, lying(i));
  }
  btCollisionShape& held_shape() {
    if (held_.getNumChildShapes() == 0) held_.addChildShape(at(0, 0, 0), &ring_);
    return held_;
  }

  ClusteredOctreeShape floor_ = shapeOver(floorMesh());
  ClusteredOctreeShape ring_ = shapeOver(testing::torus(0.6, 0.25, 24, 12));
  btCompoundShape held_;
};

using Broadphases = ::testing::Types<btDbvtBroadphase, ClusteredOctreeBroadphase>;
struct BroadphaseNames {
  template <typename Broadphase>
  static std::string GetName(int) {
    return std::is_same_v<Broadphase, btDbvtBroadphase> ? "dbvt" : "clusters";
  }
};
TYPED_TEST_SUITE(Abuse, Broadphases, BroadphaseNames);

TYPED_TEST(Abuse, shapesOfMovingBodiesAreExchanged) {
  auto gear = shapeOver(testing::gear(8, 0.5, 0.7, 0.2, 0.25));
  auto ring = shapeOver(testing::torus(0.6, 0.25, 16, 8));
  ring.setLocalScaling(btVector3(btScalar(1.2), -1, 1));
  btBoxShape box(toBullet(Vec3(0.6, 0.6, 0.25)));
  btCylinderShapeZ drum(toBullet(Vec3(0.6, 0.6, 0.25)));
  btCompoundShape compound, nested;
  compound.addChildShape(at(0.3, 0, 0), &this->ring_);
  compound.addChildShape(at(-0.5, 0, 0), &box);
  nested.addChildShape(at(0, 0, 0), &compound);
  nested.addChildShape(at(0, 0.5, 0), &gear);
  btCollisionShape* const chain[] = {&box,  &this->ring_, &compound, &gear, &nested, &drum,
                                     &ring, &compound,    &box,      &gear, &nested, &this->ring_};
  World<TypeParam> world;
  btRigidBody& floor = world.add(this->floor_, 0, at(0, 0, 0));
  for (int i = 0; i < 16; ++i) world.add(this->ring_, 1, lying(i));
  world.step(30);
  for (std::size_t round = 0; round < 3 * std::size(chain); ++round) {
    for (std::size_t i = 1; i < world.bodies().size(); ++i) {
      btRigidBody& body = *world.bodies()[i];
      // A compound's algorithm is Bullet's, which does not survive an exchange. The pair must not have one.
      ASSERT_NE(dynamic_cast<detail::MeshAlgorithm*>(world.algorithmOf(floor, body)), nullptr)
          << "round " << round << ", body " << i;
      btCollisionShape& next = *chain[(round + i) % std::size(chain)];
      btVector3 inertia;
      next.calculateLocalInertia(1, inertia);
      body.setCollisionShape(&next);
      body.setMassProps(1, inertia);
      body.activate();
    }
    world.step(1 + int(round % 3));
  }
  world.step(240);
  for (std::size_t i = 1; i < world.bodies().size(); ++i) {
    EXPECT_TRUE(world.touches(*world.bodies()[i])) << i;
    EXPECT_NEAR(double(world.bodies()[i]->getWorldTransform().getOrigin().z()), 0.25, 0.1) << i;
  }
}

/// Bullet keeps its algorithm of two convex shapes for the pair of a box and the body on it.
TYPED_TEST(Abuse, convexBodiesOnEachOtherGetOurShape) {
  btSphereShape ball(btScalar(0.3));
  btBoxShape box(toBullet(Vec3(0.6, 0.6, 0.15)));
  World<TypeParam> world;
  world.add(this->floor_, 0, at(0, 0, 0));
  std::vector<btRigidBody*> upper;
  for (int i = 0; i < 16; ++i) {
    const btTransform low = lying(i), high = low * at(0.05, 0, 0.5);
    world.add(box, 1, low);
    upper.push_back(&world.add(i % 2 == 0 ? static_cast<btCollisionShape&>(ball) : box, 1, high));
  }
  world.step(60);
  int on_boxes = 0;
  for (btRigidBody* const body : upper) {
    on_boxes += body->getWorldTransform().getOrigin().z() > btScalar(0.4);
    body->setCollisionShape(&this->ring_);
    body->activate();
  }
  EXPECT_GE(on_boxes, 8);
  world.step(240);
  for (const btRigidBody* const body : upper)
    EXPECT_GT(double(body->getWorldTransform().getOrigin().z()), 0.2);
}

TYPED_TEST(Abuse, shapesOfStaticBodiesAreExchanged) {
  auto waves = shapeOver(testing::waveSheet(6, 0.05, 24));
  BulletMesh source(*floorMesh());
  btBvhTriangleMeshShape bvh(source.view(), true);
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btBoxShape slab(toBullet(Vec3(6, 6, 0.001)));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 0), &this->floor_);
  btCollisionShape* const chain[] = {&bvh,  &this->floor_, &plane, &slab,     &waves,
                                     &slab, &bvh,          &plane, &compound, &this->floor_};
  World<TypeParam> world;
  btRigidBody& floor = world.add(this->floor_, 0, at(0, 0, 0));
  btSphereShape ball(btScalar(0.3));
  for (int i = 0; i < 16; ++i)
    world.add(i % 4 == 3 ? static_cast<btCollisionShape&>(ball) : this->ring_, 1, lying(i));
  world.step(30);
  for (int round = 0; round < 40; ++round) {
    floor.setCollisionShape(chain[std::size_t(round) % std::size(chain)]);
    world->updateSingleAabb(&floor);
    for (const auto& body : world.bodies()) body->activate();
    world.step(1 + round % 3);
  }
  ASSERT_EQ(floor.getCollisionShape(), &this->floor_);
  world.step(120);
  for (std::size_t i = 1; i < world.bodies().size(); ++i) {
    EXPECT_TRUE(world.touches(*world.bodies()[i])) << i;
    EXPECT_GT(double(world.bodies()[i]->getWorldTransform().getOrigin().z()), 0.2) << i;
  }
}

TYPED_TEST(Abuse, childrenOfCompoundsAreExchanged) {
  auto gear = shapeOver(testing::gear(8, 0.5, 0.7, 0.2, 0.25));
  btBoxShape box(toBullet(Vec3(0.6, 0.6, 0.25)));
  btCollisionShape* const children[] = {&this->ring_, &box, &gear};
  std::array<btCompoundShape, 4> compounds;  // each shared by four bodies; two of these are stacked
  for (auto& compound : compounds) {
    compound.addChildShape(at(0, 0, 0), &this->ring_);
    compound.addChildShape(at(0.2, 0, 0), &box);
  }
  World<TypeParam> world;
  world.add(this->floor_, 0, at(0, 0, 0));
  for (int i = 0; i < 16; ++i) {  // two at each position
    btTransform pose = lying(i / 2);
    pose.getOrigin().setZ(btScalar(0.3 + 0.55 * (i % 2)));
    world.add(compounds[std::size_t(i) % 4], 1, pose);
  }
  for (int round = 0; round < 60; ++round) {
    btCompoundShape& compound = compounds[std::size_t(round) % 4];
    btCollisionShape* next = children[round % 3];
    if (round % 5 == 4) {
      compound.updateChildTransform(0, at(0.1 * (round % 3), 0, 0));
    } else {
      compound.removeChildShapeByIndex(0);
      compound.addChildShape(at(0, 0.1 * (round % 2), 0), next);
    }
    world.step(2);
  }
  for (std::size_t i = 1; i < world.bodies().size(); ++i) {
    EXPECT_GT(double(world.bodies()[i]->getWorldTransform().getOrigin().z()), 0.2) << i;
  }
}

TYPED_TEST(Abuse, aShapeDeletedForAnotherLeavesNothing) {
  // The new tree is likely to reuse the old one's address.
  btBoxShape box(toBullet(Vec3(0.4, 0.3, 0.2)));
  World<TypeParam> world;
  auto shape = std::make_unique<ClusteredOctreeShape>(shapeOver(testing::torus(2, 0.7, 48, 24)));
  btRigidBody& mesh = world.add(*shape, 0, at(0, 0, 0));
  btRigidBody& brick = world.add(box, 1, at(2, 0, 0.8));
  for (int round = 0; round < 20; ++round) {
    for (int step = 0; step < 3; ++step) world->performDiscreteCollisionDetection();
    PairReport fresh;
    world->contactPairTest(&mesh, &brick, fresh);
    double deepest = 1e9;
    for (const btPersistentManifold* manifold : world.touching()) {
      for (int p = 0; p < manifold->getNumContacts(); ++p)
        deepest = std::min(deepest, double(manifold->getContactPoint(p).getDistance()));
    }
    ASSERT_FALSE(fresh.points.empty());
    ASSERT_NEAR(deepest, fresh.deepest(), 1e-5) << "round " << round;
    const bool was_ring = shape->tree().mesh().triangleCount() > 12;
    shape.reset();
    shape = std::make_unique<ClusteredOctreeShape>(
        shapeOver(was_ring ? testing::boxMesh({2.5, 2.5, 0.7}) : testing::torus(2, 0.7, 48, 24)));
    mesh.setCollisionShape(shape.get());
  }
  world.remove(mesh);
  world.remove(brick);
}

std::set<const btCollisionObject*> collected;

bool collectProcessed(btManifoldPoint&, void* body0, void* body1) {
  collected.insert({static_cast<btCollisionObject*>(body0), static_cast<btCollisionObject*>(body1)});
  return false;
}

bool collectAdded(btManifoldPoint&, const btCollisionObjectWrapper* body0, int, int,
                  const btCollisionObjectWrapper* body1, int, int) {
  collected.insert({body0->getCollisionObject(), body1->getCollisionObject()});
  return false;
}

TYPED_TEST(Abuse, bodiesThatTouchedAreDeleted) {
  for (const bool is_added : {true, false}) {
    World<TypeParam> world;
    this->addRings(world, 16);
    for (const auto& body : world.bodies()) {
      body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
    }
    const btCollisionObject* const floor = world.bodies()[0].get();
    const ContactCallbacks callbacks(is_added ? collectAdded : nullptr,
                                     is_added ? nullptr : collectProcessed);
    int deleted = 0;
    for (int step = 0; step < 60; ++step) {
      collected.clear();
      world.step(1);
      collected.erase(floor);
      if (collected.empty()) continue;
      world.remove(**collected.begin());
      ++deleted;
      world.add(this->ring_, 1, lying(deleted));  // likely to reuse the old address
    }
    EXPECT_GT(deleted, 16);
  }
}

TYPED_TEST(Abuse, bodiesAreRemovedAndDeletedInATick) {
  for (const bool before : {true, false}) {
    World<TypeParam> world;
    this->addRings(world, 16);
    int deleted = 0;
    std::vector<btRigidBody*> out;
    {
      const Tick tick(*world.operator->(), before, [&] {
        for (btRigidBody* body : out) world->addRigidBody(body);
        out.clear();
        const auto touching = world.touching();
        if (touching.empty()) return;
        const btCollisionObject *first = touching.front()->getBody0(), *last = touching.back()->getBody1();
        for (const btCollisionObject* object : {first, last}) {
          if (object->isStaticObject()) continue;
          btRigidBody* body = btRigidBody::upcast(const_cast<btCollisionObject*>(object));
          if (std::ranges::find(out, body) != out.end()) continue;
          world->removeRigidBody(body);
          out.push_back(body);  // added again in the next tick
        }
        const auto left = world.touching();
        if (left.empty()) return;
        const btCollisionObject* victim =
            left.front()->getBody0()->isStaticObject() ? left.front()->getBody1() : left.front()->getBody0();
        world.remove(*victim);
        ++deleted;
        world.add(this->ring_, 1, lying(deleted % 16));
      });
      world.step(60);
    }
    for (btRigidBody* body : out) world->addRigidBody(body);
    EXPECT_GT(deleted, 16);
    world.step(5);
  }
}

int user_data_alive = 0;

TYPED_TEST(Abuse, dataOfContactsIsReleasedOnce) {
  user_data_alive = 0;
  {
    World<TypeParam> world;
    this->addRings(world, 16);
    const ContactCallbacks callbacks(
        nullptr,
        [](btManifoldPoint& point, void*, void*) {
          if (!point.m_userPersistentData) {
            point.m_userPersistentData = new int(1);
            ++user_data_alive;
          }
          return false;
        },
        [](void* data) {
          delete static_cast<int*>(data);
          --user_data_alive;
          return false;
        });
    int most = 0;
    for (int step = 0; step < 120; ++step) {
      world.step(1);
      int points = 0;
      for (const btPersistentManifold* manifold : world.touching()) points += manifold->getNumContacts();
      most = std::max(most, user_data_alive);
      ASSERT_EQ(user_data_alive, points) << "step " << step;
      if (step % 10 == 9) this->ring_.setLocalScaling(btVector3(1, 1, btScalar(1.0 - 0.02 * (step % 3))));
    }
    EXPECT_GT(most, 20);
    while (!world.bodies().empty()) world.remove(*world.bodies().back());
  }
  EXPECT_EQ(user_data_alive, 0);
}

TYPED_TEST(Abuse, aSharedShapeIsScaledAndRefittedInContact) {
  World<TypeParam> world;
  this->addRings(world, 16);
  const testing::SharedMesh mesh = testing::torus(0.6, 0.25, 24, 12);
  const auto thinner = [&](double factor) {
    std::vector<Vec3> vertices = mesh->vertices();
    for (Vec3& vertex : vertices) vertex.z() *= factor;
    return std::make_shared<const TriangleMesh>(std::move(vertices), mesh->triangles());
  };
  std::mt19937_64 random(91);
  for (int round = 0; round < 60; ++round) {
    const double x = testing::uniform(random, 0.7, 1.2), z = testing::uniform(random, 0.7, 1.0);
    if (round % 2 == 0) this->ring_.refit(thinner(z));
    if (round % 2 == 1) this->ring_.setLocalScaling(toBullet(Vec3(x, round % 4 == 1 ? -1 : 1, z)));
    this->held_.recalculateLocalAabb();
    for (const auto& body : world.bodies()) body->activate();
    world.step(3);
  }
  this->ring_.refit(thinner(1));
  this->ring_.setLocalScaling(btVector3(1, 1, 1));
  this->held_.recalculateLocalAabb();
  world.step(240);
  for (std::size_t i = 1; i < world.bodies().size(); ++i) {
    EXPECT_NEAR(double(world.bodies()[i]->getWorldTransform().getOrigin().z()), 0.25, 0.02) << i;
  }
}

TYPED_TEST(Abuse, pairsAreCleanedInEveryTick) {
  World<TypeParam> world;
  this->addRings(world, 16);
  std::size_t turn = 0;
  const Tick tick(*world.operator->(), false, [&] {
    btRigidBody& body = *world.bodies()[turn++ % world.bodies().size()];
    world->getPairCache()->cleanProxyFromPairs(body.getBroadphaseHandle(), &world.dispatcher());
    EXPECT_FALSE(world.touches(body));
  });
  world.step(160);
  for (std::size_t i = 1; i < world.bodies().size(); ++i) {
    EXPECT_NEAR(double(world.bodies()[i]->getWorldTransform().getOrigin().z()), 0.25, 0.02) << i;
  }
}

TYPED_TEST(Abuse, fixedPoolsThatAreFullDropContacts) {
  btDefaultCollisionConstructionInfo pools;
  pools.m_defaultMaxPersistentManifoldPoolSize = 6;
  pools.m_defaultMaxCollisionAlgorithmPoolSize = 2;
  World<TypeParam> world(pools);
  world.dispatcher().setDispatcherFlags(world.dispatcher().getDispatcherFlags() |
                                        btCollisionDispatcher::CD_DISABLE_CONTACTPOOL_DYNAMIC_ALLOCATION);
  this->addRings(world, 16);
  for (int i = 0; i < 16; ++i) world.add(this->ring_, 1, lying(i) * at(0.2, 0.1, 0.3));
  std::size_t most = 0;
  for (int step = 0; step < 60; ++step) {
    world.step(1);
    most = std::max(most, world.touching().size());
    ASSERT_LE(world.dispatcher().getNumManifolds(), 6);
  }
  EXPECT_EQ(most, 6u);
  while (world.bodies().size() > 3) {  // the remaining bodies get the resources of the others
    world.remove(*world.bodies().back());
    world.step(1);
  }
  btRigidBody& body = world.add(this->ring_, 1, at(4, 4, 0.3));
  world.step(60);
  EXPECT_TRUE(world.touches(body));
}

TYPED_TEST(Abuse, anEmptiedWorldBeginsAnew) {
  World<TypeParam> world;
  std::vector<double> first;
  for (int life = 0; life < 3; ++life) {
    this->addRings(world, 16);
    world.step(60);
    std::vector<double> heights;
    for (const auto& body : world.bodies())
      heights.push_back(double(body->getWorldTransform().getOrigin().z()));
    if (life == 0) first = heights;
    EXPECT_EQ(heights, first) << "life " << life;
    while (!world.bodies().empty()) world.remove(*world.bodies().front());
    world.broadphase().resetPool(&world.dispatcher());
    world->getConstraintSolver()->reset();
  }
}

TYPED_TEST(Abuse, theWorldIsAskedInATick) {
  World<TypeParam> world;
  this->addRings(world, 16);
  btSphereShape ball(btScalar(0.2));
  std::size_t touches = 0, hits = 0;
  {
    const auto ask = [&] {
      btRigidBody& floor = *world.bodies()[0];
      for (std::size_t i = 1; i < world.bodies().size(); ++i) {
        btRigidBody& body = *world.bodies()[i];
        PairReport pair, all;
        world->contactPairTest(&floor, &body, pair);
        world->contactTest(&body, all);
        EXPECT_TRUE(pair.points.empty() || !all.points.empty());
        touches += !pair.points.empty();
        const btVector3 from = body.getWorldTransform().getOrigin() + btVector3(btScalar(0.6), 0, 3);
        const btVector3 to = from - btVector3(0, 0, 6);
        btCollisionWorld::ClosestRayResultCallback ray(from, to);
        world->rayTest(from, to, ray);
        btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
        world->convexSweepTest(&ball, btTransform(btMatrix3x3::getIdentity(), from),
                               btTransform(btMatrix3x3::getIdentity(), to), sweep);
        hits += ray.hasHit() && sweep.hasHit();
      }
    };
    const Tick tick(*world.operator->(), false, ask);
    world.step(60);
  }
  {
    // The same world without queries.
    World<TypeParam> other;
    this->addRings(other, 16);
    other.step(60);
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
      EXPECT_EQ(world.bodies()[i]->getWorldTransform().getOrigin(),
                other.bodies()[i]->getWorldTransform().getOrigin());
    }
  }
  EXPECT_GT(touches, 16u * 20u);
  EXPECT_EQ(hits, 16u * 60u);
}

btCollisionWorld* asked_world = nullptr;
int answers = 0;

/// Queries the bodies whose contact is being added.
bool askAgain(btManifoldPoint&, const btCollisionObjectWrapper* body0, int, int,
              const btCollisionObjectWrapper* body1, int, int) {
  static int depth = 0;
  if (depth > 0) return false;
  ++depth;
  PairReport report;
  asked_world->contactPairTest(const_cast<btCollisionObject*>(body0->getCollisionObject()),
                               const_cast<btCollisionObject*>(body1->getCollisionObject()), report);
  answers += !report.points.empty();
  --depth;
  return false;
}

TYPED_TEST(Abuse, theWorldIsAskedInACallback) {
  BulletMesh source(*testing::boxMesh({0.5, 0.5, 0.25}));
  btBvhTriangleMeshShape bvh(source.view(), true);
  World<TypeParam> world;
  this->addRings(world, 8);
  world.add(bvh, 0, at(0, 0, 0));
  btSphereShape ball(btScalar(0.3));
  world.add(ball, 1, at(1, 1, 0.3));
  for (const auto& body : world.bodies()) {
    body->setCollisionFlags(body->getCollisionFlags() | btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  }
  asked_world = world.operator->();
  answers = 0;
  {
    const ContactCallbacks callbacks(askAgain, nullptr);
    world.step(60);
  }
  EXPECT_GT(answers, 20);
  // Also queries in the callback of a triangle query.
  struct Asks final : btTriangleCallback {
    std::function<void()> ask;
    std::set<int> seen;
    void processTriangle(btVector3*, int, int index) override {
      EXPECT_TRUE(seen.insert(index).second);
      ask();
    }
  } asks;
  std::size_t inner = 0;
  asks.ask = [&] {
    PairReport report;
    world->contactTest(world.bodies()[1].get(), report);
    const btVector3 from(btScalar(-4), btScalar(-4.5), 3), to(btScalar(-4), btScalar(-4.5), -3);
    btCollisionWorld::AllHitsRayResultCallback ray(from, to);
    world->rayTest(from, to, ray);
    inner += !report.points.empty() && ray.hasHit();
  };
  const btVector3 far(100, 100, 100);
  this->ring_.processAllTriangles(&asks, -far, far);
  EXPECT_EQ(asks.seen.size(), this->ring_.tree().mesh().triangleCount());
  EXPECT_EQ(inner, asks.seen.size());
}

TYPED_TEST(Abuse, aShapeIsDeletedAfterItsBodies) {
  World<TypeParam> world;
  world.add(this->floor_, 0, at(0, 0, 0));
  for (int round = 0; round < 10; ++round) {
    auto shape = std::make_unique<ClusteredOctreeShape>(
        shapeOver(round % 2 ? testing::torus(0.6, 0.25, 24, 12) : testing::boxMesh({0.6, 0.6, 0.25})));
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(at(0, 0, 0), shape.get());
    for (int i = 0; i < 16; ++i)
      world.add(i % 2 ? *shape : static_cast<btCollisionShape&>(*compound), 1, lying(i));
    world.step(30);
    EXPECT_GE(world.touching().size(), 16u);
    while (world.bodies().size() > 1) world.remove(*world.bodies().back());
    compound.reset();
    shape.reset();
    world.step(2);
    EXPECT_TRUE(world.touching().empty());
  }
}

}  // namespace
}  // namespace octoblisk
