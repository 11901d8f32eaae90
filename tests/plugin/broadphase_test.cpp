// ClusteredOctreeBroadphase as Bullet's other code sees it, beside btDbvtBroadphase: pairs, filters, ghosts,
// queries, removal.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <LinearMath/btPoolAllocator.h>
#include <gtest/gtest.h>

#include <set>

#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::uniform;

std::unique_ptr<ClusteredOctreeShape> shapeOf(const testing::SharedMesh& mesh) {
  return std::make_unique<ClusteredOctreeShape>(
      std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)));
}

template <typename Broadphase>
struct World {
  World() { registerAlgorithm(&dispatcher); }
  ~World() {
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[0]);
    EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
    EXPECT_EQ(configuration.getCollisionAlgorithmPool()->getUsedCount(), 0);
  }

  btCollisionObject& add(btCollisionShape& shape, const btTransform& pose, int group = 1, int mask = -1) {
    objects.push_back(std::make_unique<btCollisionObject>());
    objects.back()->setCollisionShape(&shape);
    objects.back()->setWorldTransform(pose);
    objects.back()->setUserIndex(int(objects.size()));
    world.addCollisionObject(objects.back().get(), group, mask);
    return *objects.back();
  }
  /// As Bullet wants it: algorithms are made for a kind of shape.
  void reshape(btCollisionObject& object, btCollisionShape& shape) {
    object.setCollisionShape(&shape);
    if (btBroadphaseProxy* proxy = object.getBroadphaseHandle()) {
      broadphase.getOverlappingPairCache()->cleanProxyFromPairs(proxy, &dispatcher);
    }
  }
  int pairs() { return broadphase.getOverlappingPairCache()->getNumOverlappingPairs(); }
  bool has(btCollisionObject& a, btCollisionObject& b) {
    btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
    return cache.findPair(a.getBroadphaseHandle(), b.getBroadphaseHandle()) != nullptr;
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  Broadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  std::vector<std::unique_ptr<btCollisionObject>> objects;
};

using Tight = World<ClusteredOctreeBroadphase>;
using Stock = World<btDbvtBroadphase>;

TEST(Broadphase, aSphereInTheHoleOfATorusIsNoPair) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  Tight tight;
  btCollisionObject& ring = tight.add(*torus, at(5, 6, 7));
  btCollisionObject& ball = tight.add(sphere, at(5, 6, 7));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_EQ(tight.broadphase.tightPairs(), 0);
  EXPECT_EQ(tight.dispatcher.getNumManifolds(), 0);

  ball.setWorldTransform(at(6.2, 6, 7));  // into the tube
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.tightPairs(), 1);
  ASSERT_TRUE(tight.has(ring, ball));
  ASSERT_GT(tight.dispatcher.getNumManifolds(), 0);
  EXPECT_GT(tight.dispatcher.getManifoldByIndexInternal(0)->getNumContacts(), 0);

  ball.setWorldTransform(at(5, 6, 7));  // back: the algorithm and its manifold go with the pair
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_EQ(tight.pairs(), 0);
  EXPECT_EQ(tight.dispatcher.getNumManifolds(), 0);
}

TEST(Broadphase, aTurnMakesAPairThoughNoBoxChanges) {
  // A blade that turns about its own middle, in a box of half its size: the sphere's corner is free, then
  // not.
  const auto blade = shapeOf(testing::boxMesh({2, 0.05, 0.05}));
  const auto torus = shapeOf(testing::torus(2, 0.1, 48, 12));
  btSphereShape sphere(btScalar(0.2));
  btCompoundShape cross;  // its box is the same a quarter turn on
  cross.addChildShape(at(0, 0, 0), blade.get());
  cross.addChildShape(btTransform(btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI)), blade.get());
  Tight tight;
  btCollisionObject& turning = tight.add(cross, at(0, 0, 0));
  btCollisionObject& ball = tight.add(sphere, at(1, 1, 0));
  for (int i = 0; i < 4; ++i) {
    turning.setWorldTransform(btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(i) * SIMD_HALF_PI / 2)));
    tight.world.performDiscreteCollisionDetection();
    EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
    EXPECT_EQ(tight.has(turning, ball), i % 2 == 1) << i;
  }
}

TEST(Broadphase, ofTwoOfOursTheClustersCount) {
  const auto ring = shapeOf(testing::torus(2, 0.25, 48, 24)),
             small = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  Tight tight;
  btCollisionObject& outer = tight.add(*ring, at(0, 0, 0));
  btCollisionObject& inner = tight.add(*small, at(0, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.broadphase.coarsePairs(), 1);
  EXPECT_FALSE(tight.has(outer, inner));
  inner.setWorldTransform(at(0.75, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_TRUE(tight.has(outer, inner));
}

TEST(Broadphase, shapesMarginsAndScalesAreReadAnew) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5)), large(btScalar(1.6));
  btBoxShape box(btVector3(2, 2, 2));
  Tight tight;
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  btCollisionObject& ball = tight.add(sphere, at(0, 0, 0));
  const auto found = [&] {
    tight.world.performDiscreteCollisionDetection();
    return tight.has(ring, ball);
  };
  EXPECT_FALSE(found());
  tight.reshape(ball, large);
  EXPECT_TRUE(found());
  tight.reshape(ball, sphere);
  EXPECT_FALSE(found());
  tight.reshape(ring, box);  // not ours: the boxes decide
  EXPECT_TRUE(found());
  tight.reshape(ring, *torus);
  EXPECT_FALSE(found());
  torus->setMargin(btScalar(1.05));
  EXPECT_TRUE(found());
  torus->setMargin(0);
  EXPECT_FALSE(found());
  torus->setLocalScaling(btVector3(btScalar(0.3), 1, 1));
  EXPECT_TRUE(found());
}

TEST(Broadphase, theFilterIsAskedOnInsertionAlone) {
  struct Filter final : btOverlapFilterCallback {
    mutable int asked = 0;
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      ++asked;  // and the masks do not count
      return static_cast<btCollisionObject*>(a->m_clientObject)->getUserIndex() +
                 static_cast<btCollisionObject*>(b->m_clientObject)->getUserIndex() !=
             4;
    }
  };
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  const auto run = [&](auto& world) {
    Filter filter;
    world.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
    btCollisionObject& ring = world.add(*torus, at(0, 0, 0), 1, 0);
    btCollisionObject& first = world.add(sphere, at(2, 0, 0), 1, 0);
    btCollisionObject& second = world.add(sphere, at(2.1, 0, 0), 1, 0);
    for (int i = 0; i < 10; ++i) {  // in and out of the tube, within the inner broadphase's box
      first.setWorldTransform(at(i % 2 == 0 ? 2 : 0, 0, 0));
      world.world.performDiscreteCollisionDetection();
    }
    second.setWorldTransform(at(2, 0, 0));
    first.setWorldTransform(at(2, 0, 0));
    world.world.performDiscreteCollisionDetection();
    EXPECT_TRUE(world.has(ring, first));
    EXPECT_FALSE(world.has(ring, second));  // 1 + 3
    EXPECT_TRUE(world.has(first, second));
    EXPECT_EQ(world.broadphase.getOverlappingPairCache()->getOverlapFilterCallback(), &filter);
    world.broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
    return filter.asked;
  };
  Tight tight;
  Stock stock;
  EXPECT_EQ(run(tight), run(stock));
}

TEST(Broadphase, masksCountWithoutAFilter) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  Tight tight;
  tight.add(*torus, at(0, 0, 0), 1, 2);
  tight.add(sphere, at(2, 0, 0), 2, 1);
  tight.add(sphere, at(-2, 0, 0), 4, 1);
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(tight.pairs(), 1);
}

TEST(Broadphase, ghostsAreToldByTheirBoxes) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  btGhostPairCallback callback;
  btPairCachingGhostObject ghost;
  ghost.setCollisionShape(&sphere);
  ghost.setWorldTransform(at(0, 0, 0));
  Tight tight;
  tight.broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&callback);
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  tight.world.addCollisionObject(&ghost);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);  // at once, as with btDbvtBroadphase
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  EXPECT_EQ(ghost.getOverlappingPairCache()->getNumOverlappingPairs(), 1);
  ring.setWorldTransform(at(50, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
  ring.setWorldTransform(at(0, 0, 0));
  tight.world.performDiscreteCollisionDetection();
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 1);
  tight.world.removeCollisionObject(&ring);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
}

/// What a query calls back with.
struct Seen final : btBroadphaseRayCallback {
  explicit Seen(const btVector3& direction = btVector3(1, 1, 1), btScalar length = 1) {
    for (int i = 0; i < 3; ++i) {
      m_rayDirectionInverse[i] = direction[i] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[i];
      m_signs[i] = m_rayDirectionInverse[i] < 0;
    }
    m_lambda_max = length;
  }
  bool process(const btBroadphaseProxy* proxy) override {
    order.push_back(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
    return true;
  }
  std::vector<int> order;
};

std::vector<std::pair<int, int>> pairsOf(btBroadphaseInterface& broadphase) {
  std::vector<std::pair<int, int>> found;
  btBroadphasePairArray& pairs = broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    found.emplace_back(static_cast<btCollisionObject*>(pairs[i].m_pProxy0->m_clientObject)->getUserIndex(),
                       static_cast<btCollisionObject*>(pairs[i].m_pProxy1->m_clientObject)->getUserIndex());
  }
  return found;
}

/// The same life in both broadphases: objects move, come, go and change their shapes. Calls
/// check(stock, tight) after each step.
template <typename Check>
void liveTwice(const std::vector<btCollisionShape*>& shapes, Check&& check) {
  Stock stock;
  Tight tight;
  std::mt19937_64 random(73);
  const auto place = [&] {
    return at(uniform(random, -6, 6), uniform(random, -6, 6), uniform(random, -6, 6));
  };
  const auto anyShape = [&] { return shapes[random() % shapes.size()]; };
  for (int i = 0; i < 100; ++i) {
    btCollisionShape& shape = *anyShape();
    const btTransform pose = place();
    stock.add(shape, pose);
    tight.add(shape, pose);
  }
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = 0; i < stock.objects.size(); ++i) {
      if (random() % 3 == 0) continue;
      const btTransform pose = at(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), 0) *
                               stock.objects[i]->getWorldTransform();
      btCollisionShape* shape = random() % 20 == 0 ? anyShape() : nullptr;
      const bool toggled = random() % 15 == 0;
      const auto change = [&](auto& world) {
        btCollisionObject& object = *world.objects[i];
        object.setWorldTransform(pose);
        if (shape) world.reshape(object, *shape);
        if (toggled && object.getBroadphaseHandle()) {
          world.world.removeCollisionObject(&object);
        } else if (toggled) {
          world.world.addCollisionObject(&object);
        }
      };
      change(stock);
      change(tight);
    }
    stock.world.performDiscreteCollisionDetection();
    tight.world.performDiscreteCollisionDetection();
    check(stock, tight, random);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(Broadphase, worldsWithoutOursAreAsEver) {
  btSphereShape sphere(btScalar(0.7));
  btBoxShape box(toBullet(Vec3(0.9, 0.3, 0.5)));
  btCompoundShape compound;
  compound.addChildShape(at(1, 0, 0), &box);
  compound.addChildShape(at(-1, 0, 0), &sphere);
  std::size_t most = 0;
  liveTwice({&sphere, &box, &compound}, [&](Stock& stock, Tight& tight, std::mt19937_64&) {
    ASSERT_EQ(pairsOf(tight.broadphase), pairsOf(stock.broadphase));  // in the same order
    EXPECT_EQ(tight.broadphase.coarsePairs(), tight.broadphase.tightPairs());
    most = std::max(most, pairsOf(stock.broadphase).size());
  });
  EXPECT_GT(most, 50u);
}

TEST(Broadphase, raysBoxesAndCoarsePairsAreAsEver) {
  const auto torus = shapeOf(testing::torus(1, 0.2, 24, 12));
  btSphereShape sphere(btScalar(0.4));
  std::size_t rays = 0, boxes = 0, stock_pairs = 0, tight_pairs = 0;
  liveTwice({torus.get(), &sphere}, [&](Stock& stock, Tight& tight, std::mt19937_64& random) {
    const auto there = pairsOf(stock.broadphase), here = pairsOf(tight.broadphase);
    ASSERT_EQ(std::size_t(tight.broadphase.coarsePairs()), there.size());
    const std::set<std::pair<int, int>> coarse(there.begin(), there.end());
    for (const auto& pair : here) ASSERT_TRUE(coarse.contains(pair));
    ASSERT_EQ(std::set(here.begin(), here.end()).size(), here.size());
    stock_pairs += there.size();
    tight_pairs += here.size();

    const btVector3 from = toBullet(testing::randomPoint(random, 8));
    const btVector3 to = toBullet(testing::randomPoint(random, 8));
    const btVector3 direction = (to - from).normalized();
    Seen ray(direction, (to - from).length()), same_ray(direction, (to - from).length());
    stock.broadphase.rayTest(from, to, ray);
    tight.broadphase.rayTest(from, to, same_ray);
    ASSERT_EQ(same_ray.order, ray.order);
    rays += ray.order.size();
    btVector3 low = from, high = from;
    low.setMin(to);
    high.setMax(to);
    Seen box, same_box;
    stock.broadphase.aabbTest(low, high, box);
    tight.broadphase.aabbTest(low, high, same_box);
    ASSERT_EQ(same_box.order, box.order);
    boxes += box.order.size();
    btVector3 all_low, all_high, same_low, same_high;
    stock.broadphase.getBroadphaseAabb(all_low, all_high);
    tight.broadphase.getBroadphaseAabb(same_low, same_high);
    ASSERT_TRUE(all_low == same_low && all_high == same_high);
  });
  EXPECT_GT(rays, 30u);
  EXPECT_GT(boxes, 100u);
  EXPECT_GT(tight_pairs, stock_pairs / 10);
  EXPECT_LT(tight_pairs, stock_pairs * 9 / 10);
}

TEST(Broadphase, whatAUserRemovesWhileIteratingIsGone) {
  struct RemoveEverySecond final : btOverlapCallback {
    int seen = 0;
    bool processOverlap(btBroadphasePair&) override { return ++seen % 2 == 0; }
  };
  const auto torus = shapeOf(testing::torus(2, 0.5, 24, 12));
  btSphereShape sphere(btScalar(0.5));
  Tight tight;
  btCollisionObject& ring = tight.add(*torus, at(0, 0, 0));
  for (int i = 0; i < 8; ++i) tight.add(sphere, at(2 * std::cos(0.785 * i), 2 * std::sin(0.785 * i), 0));
  tight.world.performDiscreteCollisionDetection();
  btOverlappingPairCache& cache = *tight.broadphase.getOverlappingPairCache();
  const int all = tight.pairs();
  ASSERT_GE(all, 8);
  RemoveEverySecond remove;
  cache.processAllOverlappingPairs(&remove, &tight.dispatcher);
  EXPECT_EQ(remove.seen, all);
  EXPECT_EQ(tight.pairs(), all - all / 2);
  EXPECT_EQ(tight.broadphase.coarsePairs(), tight.pairs());
  tight.world.performDiscreteCollisionDetection();  // nobody has left his box: no new pairs, as in Bullet
  EXPECT_EQ(tight.pairs(), all - all / 2);

  cache.sortOverlappingPairs(&tight.dispatcher);
  EXPECT_EQ(tight.pairs(), all - all / 2);
  btBroadphaseProxy* proxy = ring.getBroadphaseHandle();
  cache.cleanProxyFromPairs(proxy, &tight.dispatcher);
  for (int i = 0; i < tight.pairs(); ++i) {
    const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[i];
    const bool is_of_ring = pair.m_pProxy0 == proxy || pair.m_pProxy1 == proxy;
    EXPECT_NE(pair.m_algorithm == nullptr, !is_of_ring);
  }
  btBroadphaseProxy* other = tight.objects.back()->getBroadphaseHandle();
  cache.removeOverlappingPairsContainingProxy(proxy, &tight.dispatcher);
  EXPECT_EQ(cache.findPair(proxy, other), nullptr);
  EXPECT_NE(cache.addOverlappingPair(proxy, other), nullptr);
  tight.world.performDiscreteCollisionDetection();
  EXPECT_NE(cache.findPair(proxy, other), nullptr);
}

TEST(Broadphase, resetWhenEmptyItNumbersAnew) {
  btSphereShape sphere(btScalar(0.5));
  Tight tight;
  btCollisionObject& first = tight.add(sphere, at(0, 0, 0));
  const int id = first.getBroadphaseHandle()->getUid();
  tight.world.removeCollisionObject(&first);
  tight.broadphase.resetPool(&tight.dispatcher);
  tight.world.addCollisionObject(&first);
  EXPECT_EQ(first.getBroadphaseHandle()->getUid(), id);
}

TEST(Broadphase, statisticsAreThoseOfTheBoxes) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 3), torus.get());
  compound.addChildShape(at(0, 0, -3), torus.get());
  for (const int depth : {0, 2}) {
    ClusteredOctreeBroadphase broadphase(depth);
    EXPECT_EQ(broadphase.depth(), depth);
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    btCollisionWorld world(&dispatcher, &broadphase, &configuration);
    btCollisionObject ring, two_rings, ball;
    ring.setCollisionShape(torus.get());
    two_rings.setCollisionShape(&compound);
    two_rings.setWorldTransform(at(50, 0, 0));
    ball.setCollisionShape(&sphere);
    for (btCollisionObject* object : {&ring, &two_rings, &ball}) world.addCollisionObject(object);
    world.performDiscreteCollisionDetection();
    double clusters = 0.0;
    for (const Obb& box : torus->tree().boxes(depth)) clusters += box.volume();
    const BroadphaseStatistics statistics = broadphase.statistics();
    EXPECT_EQ(statistics.coarse_pairs, 1);
    EXPECT_EQ(statistics.tight_pairs, depth == 0 ? 1 : 0);
    EXPECT_NEAR(statistics.cluster_volume, 3 * clusters, 1e-9 * clusters);
    const double near = 2 * double(gContactBreakingThreshold);
    EXPECT_NEAR(statistics.box_volume, (5 + near) * (5 + near) * ((1 + near) + (7 + near)), 0.5);
    const double root = torus->tree().stats().root_volume;
    EXPECT_EQ(statistics.cluster_volume < 0.7 * (3 * root), depth == 2);
  }
}

}  // namespace
}  // namespace octoblisk
