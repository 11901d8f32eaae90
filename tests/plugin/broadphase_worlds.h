// Collision worlds with ClusteredOctreeBroadphase and with Bullet's, for tests that compare them.
#pragma once

#include <LinearMath/btPoolAllocator.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk::testing {

inline std::unique_ptr<ClusteredOctreeShape> shapeOf(const SharedMesh& mesh) {
  return std::make_unique<ClusteredOctreeShape>(treeOver(mesh));
}

/// Uses the boxes of btDbvtBroadphase. It notices only some steps later that boxes no longer overlap.
inline bool boxesOverlap(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
  return Intersect(static_cast<const btDbvtProxy*>(a)->leaf->volume,
                   static_cast<const btDbvtProxy*>(b)->leaf->volume);
}

/// When destroyed, removes all objects and expects that no pair, manifold or algorithm remains.
template <typename Broadphase>
struct BroadphaseWorld {
  BroadphaseWorld() { registerAlgorithm(&dispatcher); }
  ~BroadphaseWorld() {
    while (world.getNumCollisionObjects() > 0)
      world.removeCollisionObject(world.getCollisionObjectArray()[0]);
    EXPECT_EQ(pairs(), 0);
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
    EXPECT_EQ(configuration.getCollisionAlgorithmPool()->getUsedCount(), 0);
  }
  BroadphaseWorld(const BroadphaseWorld&) = delete;
  BroadphaseWorld& operator=(const BroadphaseWorld&) = delete;

  /// Objects are numbered from 1.
  btCollisionObject& add(btCollisionShape& shape, const btTransform& pose, int group = 1, int mask = -1) {
    objects.push_back(std::make_unique<btCollisionObject>());
    objects.back()->setCollisionShape(&shape);
    objects.back()->setWorldTransform(pose);
    objects.back()->setUserIndex(int(objects.size()));
    world.addCollisionObject(objects.back().get(), group, mask);
    return *objects.back();
  }
  /// Changes the shape as Bullet requires, because its algorithms are made for a kind of shape.
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
  /// All pairs by the numbers of their objects, in the cache's order.
  std::vector<std::pair<int, int>> pairsByNumber() {
    return pairsWhere([](const btBroadphasePair&) { return true; });
  }
  std::vector<std::pair<int, int>> overlappingPairs() {
    return pairsWhere(
        [](const btBroadphasePair& pair) { return boxesOverlap(pair.m_pProxy0, pair.m_pProxy1); });
  }
  template <typename Condition>
  std::vector<std::pair<int, int>> pairsWhere(const Condition& condition) {
    const auto number = [](const btBroadphaseProxy* proxy) {
      return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
    };
    std::vector<std::pair<int, int>> found;
    btBroadphasePairArray& all = broadphase.getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < all.size(); ++i)
      if (condition(all[i])) found.emplace_back(number(all[i].m_pProxy0), number(all[i].m_pProxy1));
    return found;
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  Broadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  std::vector<std::unique_ptr<btCollisionObject>> objects;
};

/// A dynamics world. When destroyed, removes all bodies and expects that nothing remains of their pairs.
template <typename Broadphase>
struct DynamicWorld {
  DynamicWorld() { registerAlgorithm(&dispatcher); }
  ~DynamicWorld() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
    EXPECT_EQ(pairs(), 0);
    if constexpr (requires { broadphase.coarsePairs(); }) {
      EXPECT_EQ(broadphase.coarsePairs(), 0);
    }
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
    EXPECT_EQ(configuration.getCollisionAlgorithmPool()->getUsedCount(), 0);
  }

  /// Bodies are numbered from 1.
  btRigidBody& add(btCollisionShape& shape, btScalar mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform = pose;
    bodies.push_back(std::make_unique<btRigidBody>(info));
    bodies.back()->setUserIndex(int(bodies.size()));
    world.addRigidBody(bodies.back().get());
    return *bodies.back();
  }
  int pairs() { return broadphase.getOverlappingPairCache()->getNumOverlappingPairs(); }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  Broadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btRigidBody>> bodies;
};

/// Expects the same pairs of overlapping boxes as with btDbvtBroadphase, and that Bullet sees a subset of
/// them, each once.
template <typename Stock, typename Tight>
void expectPairsOf(Stock& stock, Tight& tight) {
  const auto there = stock.overlappingPairs(), here = tight.overlappingPairs();
  const std::set<std::pair<int, int>> all(there.begin(), there.end()), kept(here.begin(), here.end());
  ASSERT_EQ(kept.size(), here.size());
  ASSERT_TRUE(std::ranges::includes(all, kept));
  const std::size_t parted = tight.pairsByNumber().size() - here.size();
  ASSERT_EQ(std::size_t(tight.broadphase.coarsePairs()) - parted, all.size());
}

using TightWorld = BroadphaseWorld<ClusteredOctreeBroadphase>;
using StockWorld = BroadphaseWorld<btDbvtBroadphase>;

}  // namespace octoblisk::testing
