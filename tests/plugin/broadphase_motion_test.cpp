// Compares piles with ClusteredOctreeBroadphase and with btDbvtBroadphase: motion, sleep, and touching
// bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "plugin/broadphase_worlds.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::shapeOf;

template <typename Broadphase>
struct Pile : testing::DynamicWorld<Broadphase> {
  Pile() { this->world.setGravity(btVector3(0, 0, btScalar(-9.81))); }
  void step() { this->world.stepSimulation(btScalar(1.0 / 60.0), 0); }

  std::vector<int> sleepers() const {
    std::vector<int> found;
    for (const auto& body : this->bodies)
      if (!body->isActive()) found.push_back(body->getUserIndex());
    return found;
  }
  std::set<std::pair<int, int>> touching() {
    std::set<std::pair<int, int>> found;
    for (int m = 0; m < this->dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *this->dispatcher.getManifoldByIndexInternal(m);
      if (manifold.getNumContacts() > 0)
        found.emplace(manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex());
    }
    return found;
  }
  std::size_t points() { return testing::manifoldPoints(this->dispatcher).size(); }
};

/// The same pile with both broadphases.
struct Piles {
  void add(btCollisionShape& shape, btScalar mass, const btTransform& pose) {
    stock.add(shape, mass, pose);
    tight.add(shape, mass, pose);
  }
  void step() {
    stock.step();
    tight.step();
  }
  double farthestApart() const {
    double most = 0.0;
    for (std::size_t i = 0; i < stock.bodies.size(); ++i)
      most = std::max(most, double((stock.bodies[i]->getWorldTransform().getOrigin() -
                                    tight.bodies[i]->getWorldTransform().getOrigin())
                                       .length()));
    return most;
  }

  Pile<btDbvtBroadphase> stock;
  Pile<ClusteredOctreeBroadphase> tight;
};

/// Towers of bodies at most 0.6 high, dropped from a small height.
struct Towers : Piles {
  Towers(const std::vector<btCollisionShape*>& shapes, double distance) {
    add(*floor, 0, at(0, 0, 0));
    std::mt19937_64 random(77);
    for (int tower = 0; tower < 16; ++tower) {
      for (int level = 0; level < 4; ++level) {
        btTransform pose =
            at(distance * (tower % 4 - 1.5), distance * (tower / 4 - 1.5), 0.32 + 0.63 * level);
        pose.setRotation(btQuaternion(btVector3(0, 0, 1), btScalar(testing::uniform(random, -0.1, 0.1))));
        add(*shapes[std::size_t(tower + level) % shapes.size()], 1, pose);
      }
    }
  }
  const std::unique_ptr<ClusteredOctreeShape> floor = shapeOf(testing::waveSheet(12, 0.0, 50));
};

TEST(BroadphaseMotion, isTheSameToTheLastBitWhereNoPairIsKeptApart) {
  const auto block = shapeOf(testing::boxMesh({0.5, 0.4, 0.3}));
  btBoxShape box(btVector3(btScalar(0.4), btScalar(0.5), btScalar(0.3)));
  Towers towers({&box, block.get()}, 3.0);
  for (int step = 0; step < 300; ++step) {
    towers.step();
    ASSERT_EQ(towers.tight.broadphase.coarsePairs(), towers.tight.pairs()) << "step " << step;
    ASSERT_EQ(towers.farthestApart(), 0.0) << "step " << step;
    ASSERT_EQ(towers.tight.sleepers(), towers.stock.sleepers()) << "step " << step;
    ASSERT_EQ(towers.tight.points(), towers.stock.points()) << "step " << step;
  }
  EXPECT_GT(towers.stock.points(), 64u);
  EXPECT_EQ(towers.stock.sleepers().size(), 65u);
}

/// Each ring on the floor has a ball in its hole.
TEST(BroadphaseMotion, aPileWithHolesFallsAsleepAlike) {
  const auto block = shapeOf(testing::boxMesh({0.7, 0.65, 0.3})),
             ring = shapeOf(testing::torus(0.6, 0.28, 32, 16));
  btBoxShape box(btVector3(btScalar(0.65), btScalar(0.7), btScalar(0.3)));
  btSphereShape ball(btScalar(0.1));
  Towers towers({&box, ring.get(), block.get()}, 2.1);
  for (int i = 1; i < 16; i += 3) towers.add(ball, 1, at(2.1 * (i % 4 - 1.5), 2.1 * (i / 4 - 1.5), 0.11));
  for (int step = 0; step < 300; ++step) towers.step();
  EXPECT_LT(towers.tight.pairs(), towers.stock.pairs());
  EXPECT_EQ(towers.tight.sleepers(), towers.stock.sleepers());
  EXPECT_EQ(towers.tight.touching(), towers.stock.touching());
  EXPECT_EQ(towers.stock.sleepers().size(), towers.stock.bodies.size());
  // The solver processes the contacts in a different order.
  EXPECT_LT(towers.farthestApart(), 0.1);
}

}  // namespace
}  // namespace octoblisk
