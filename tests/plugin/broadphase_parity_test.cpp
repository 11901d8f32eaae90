// Without clusters to decide, ClusteredOctreeBroadphase equals btDbvtBroadphase: pairs of other shapes,
// coarse pairs, rays, boxes.
#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/broadphase_worlds.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::shapeOf;
using testing::StockWorld;
using testing::TightWorld;
using testing::uniform;

/// The results of a query's callback.
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

/// Makes the same changes in both broadphases: objects move, appear, disappear and change their shapes. Calls
/// check(stock, tight, random) after each step.
template <typename Check>
void liveTwice(const std::vector<btCollisionShape*>& shapes, Check&& check) {
  StockWorld stock;
  TightWorld tight;
  std::mt19937_64 random(73);
  const auto place = [&] {
    const double x = uniform(random, -6, 6), y = uniform(random, -6, 6);
    return at(x, y, uniform(random, -6, 6));
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
      const double x = uniform(random, -0.5, 0.5), y = uniform(random, -0.5, 0.5);
      const btTransform pose = at(x, y, 0) * stock.objects[i]->getWorldTransform();
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
  liveTwice({&sphere, &box, &compound}, [&](StockWorld& stock, TightWorld& tight, std::mt19937_64&) {
    ASSERT_EQ(tight.pairsByNumber(), stock.pairsByNumber());  // in the same order
    EXPECT_EQ(tight.broadphase.coarsePairs(), tight.pairs());
    most = std::max(most, stock.pairsByNumber().size());
  });
  EXPECT_GT(most, 50u);
}

TEST(Broadphase, raysBoxesAndCoarsePairsAreAsEver) {
  const auto torus = shapeOf(testing::torus(1, 0.2, 24, 12));
  btSphereShape sphere(btScalar(0.4));
  std::size_t rays = 0, boxes = 0, stock_pairs = 0, tight_pairs = 0;
  liveTwice({torus.get(), &sphere}, [&](StockWorld& stock, TightWorld& tight, std::mt19937_64& random) {
    ASSERT_NO_FATAL_FAILURE(testing::expectPairsOf(stock, tight));
    stock_pairs += stock.pairsByNumber().size();
    tight_pairs += tight.pairsByNumber().size();

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

}  // namespace
}  // namespace octoblisk
