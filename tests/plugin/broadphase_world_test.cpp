// Whole worlds with ClusteredOctreeBroadphase beside the same ones with btDbvtBroadphase: every contact is
// there, nothing leaks, nothing falls through.
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "plugin/bullet_world.h"
#include "plugin/partners.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::uniform;

std::unique_ptr<ClusteredOctreeShape> shapeOf(const testing::SharedMesh& mesh) {
  return std::make_unique<ClusteredOctreeShape>(
      std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)));
}

/// A body as it is to be in both worlds.
struct Mover {
  btCollisionShape* shape;
  Pose pose;
  Vec3 velocity, spin_axis;
  double spin;
  bool is_there = true;
};

/// On bodies by their numbers, of each pair sorted.
using Point = std::array<double, 7>;
using Contacts = std::map<std::pair<int, int>, std::vector<Point>>;

template <typename Broadphase>
class World {
 public:
  World() { registerAlgorithm(&dispatcher_); }
  ~World() {
    for (const auto& object : objects_) {
      if (object->getBroadphaseHandle()) world_.removeCollisionObject(object.get());
    }
    EXPECT_EQ(pairs(), 0);
    EXPECT_EQ(dispatcher_.getNumManifolds(), 0);
  }

  /// Contacts at the movers' poses.
  Contacts step(const std::vector<Mover>& movers) {
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const bool is_new = i == objects_.size();
      if (is_new) objects_.push_back(std::make_unique<btCollisionObject>());
      btCollisionObject& object = *objects_[i];
      object.setUserIndex(int(i));
      object.setWorldTransform(toBullet(movers[i].pose));
      if (object.getCollisionShape() != movers[i].shape) {
        object.setCollisionShape(movers[i].shape);
        btBroadphaseProxy* proxy = object.getBroadphaseHandle();
        if (proxy) world_.getPairCache()->cleanProxyFromPairs(proxy, &dispatcher_);
      }
      if (movers[i].is_there && !object.getBroadphaseHandle()) world_.addCollisionObject(&object);
      if (!movers[i].is_there && object.getBroadphaseHandle()) world_.removeCollisionObject(&object);
    }
    world_.performDiscreteCollisionDetection();
    return contacts();
  }

  int pairs() const { return broadphase_.getOverlappingPairCache()->getNumOverlappingPairs(); }

 private:
  Contacts contacts() {
    Contacts found;
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
      const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
      for (int p = 0; p < manifold.getNumContacts(); ++p) {
        const btManifoldPoint& point = manifold.getContactPoint(p);
        Vec3 on_a = fromBullet(point.m_positionWorldOnA), on_b = fromBullet(point.m_positionWorldOnB);
        if (b < a) std::swap(on_a, on_b);
        found[std::minmax(a, b)].push_back(
            {on_a.x(), on_a.y(), on_a.z(), on_b.x(), on_b.y(), on_b.z(), double(point.getDistance())});
      }
    }
    for (auto& [pair, points] : found) std::ranges::sort(points);
    return found;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  Broadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

/// Shapes of every kind, of which about one in two is ours or holds ours.
class Shapes {
 public:
  Shapes() {
    for (const auto& partners : {testing::convexPartners(), testing::concavePartners()}) {
      for (const testing::Partner& partner : partners) {
        made_.push_back(partner.make());
        others_.push_back(made_.back().shape.get());
      }
    }
    const auto add = [&](const testing::SharedMesh& mesh) -> ClusteredOctreeShape& {
      ours_.push_back(shapeOf(mesh));
      return *ours_.back();
    };
    ClusteredOctreeShape& torus = add(testing::torus(2, 0.3, 32, 12));
    add(testing::torus(2, 0.3, 32, 12)).setMargin(btScalar(0.15));
    add(testing::torus(1.5, 0.3, 32, 12)).setContactBreakingThreshold(btScalar(0.2));
    add(testing::fan(5, 8));
    add(testing::fan(9, 6)).setLocalScaling(btVector3(btScalar(1.2), btScalar(-0.8), btScalar(1.5)));
    compound_.addChildShape(at(0, 0, 2), &torus);
    compound_.addChildShape(at(0, 0, -2), &ball_);
    compound_.addChildShape(btTransform(btQuaternion(btVector3(1, 0, 0), 1), btVector3(2, 0, 0)), &torus);
    nested_.addChildShape(at(1, 0, 0), &compound_);
    nested_.addChildShape(at(-3, 0, 0), &ball_);
  }

  btCollisionShape* any(std::mt19937_64& random) {
    if (random() % 10 == 0) return random() % 2 == 0 ? &compound_ : &nested_;
    if (random() % 2 == 0) return ours_[random() % ours_.size()].get();
    return others_[random() % others_.size()];
  }

 private:
  std::vector<testing::Made> made_;
  std::vector<btCollisionShape*> others_;
  std::vector<std::unique_ptr<ClusteredOctreeShape>> ours_;
  btSphereShape ball_{btScalar(0.5)};
  btCompoundShape compound_, nested_;
};

class BroadphaseWorld : public ::testing::TestWithParam<double> {};
// Mesh units a step: about still, slow, and past the boxes that Bullet keeps.
INSTANTIATE_TEST_SUITE_P(speeds, BroadphaseWorld, ::testing::Values(0.002, 0.05, 1.0));

TEST_P(BroadphaseWorld, everyContactIsThere) {
  constexpr double kHalfSize = 9;
  const double speed = GetParam();
  Shapes shapes;
  std::mt19937_64 random(74);
  std::vector<Mover> movers;
  const auto add = [&] {
    movers.push_back({shapes.any(random), testing::randomPose(random, kHalfSize),
                      testing::randomPoint(random, speed), testing::randomPoint(random, 1).normalized(),
                      uniform(random, -speed, speed)});
  };
  for (int i = 0; i < 140; ++i) add();
  World<btDbvtBroadphase> stock;
  World<ClusteredOctreeBroadphase> tight;
  std::size_t touching = 0, points = 0, stock_pairs = 0, tight_pairs = 0;
  for (int step = 0; step < 24; ++step) {
    const Contacts expected = stock.step(movers), found = tight.step(movers);
    ASSERT_EQ(found.size(), expected.size()) << "step " << step;
    for (const auto& [pair, of_pair] : expected) {
      ASSERT_TRUE(found.contains(pair)) << "step " << step << ": " << pair.first << ", " << pair.second;
      ASSERT_EQ(found.at(pair), of_pair) << "step " << step << ": " << pair.first << ", " << pair.second;
      points += of_pair.size();
    }
    touching += expected.size();
    stock_pairs += std::size_t(stock.pairs());
    tight_pairs += std::size_t(tight.pairs());
    for (Mover& mover : movers) {
      mover.pose.translation += mover.velocity;
      mover.pose.rotation = Eigen::AngleAxisd(mover.spin, mover.spin_axis) * mover.pose.rotation;
      if (mover.pose.translation.norm() > 2 * kHalfSize) mover.velocity = -mover.velocity;
      if (random() % 40 == 0) mover.is_there = !mover.is_there;
      if (random() % 60 == 0) mover.shape = shapes.any(random);
    }
    if (step % 10 == 0) add();
  }
  EXPECT_GT(points, touching);
  EXPECT_GT(touching, stock_pairs / 10);
  EXPECT_LT(tight_pairs, stock_pairs * 9 / 10);
  EXPECT_GE(tight_pairs, touching);
  RecordProperty("stock_pairs", int(stock_pairs));
  RecordProperty("tight_pairs", int(tight_pairs));
  RecordProperty("touching", int(touching));
}

/// A dynamics world with our broadphase.
struct DynamicWorld {
  DynamicWorld() { registerAlgorithm(&dispatcher); }
  ~DynamicWorld() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
    EXPECT_EQ(broadphase.coarsePairs(), 0);
    EXPECT_EQ(broadphase.tightPairs(), 0);
    EXPECT_EQ(dispatcher.getNumManifolds(), 0);
  }
  btRigidBody& add(btCollisionShape& shape, btScalar mass, const btTransform& pose) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform = pose;
    bodies.push_back(std::make_unique<btRigidBody>(info));
    world.addRigidBody(bodies.back().get());
    return *bodies.back();
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  ClusteredOctreeBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btRigidBody>> bodies;
};

TEST(BroadphaseWorld, nothingFallsThrough) {
  const auto floor = shapeOf(testing::waveSheet(10, 0.4, 48));
  const auto ring = shapeOf(testing::torus(0.8, 0.3, 24, 12));
  btSphereShape sphere(btScalar(0.4));
  btBoxShape box(toBullet(Vec3(0.4, 0.3, 0.5)));
  btCompoundShape compound;
  compound.addChildShape(at(0, 0, 0), ring.get());
  compound.addChildShape(at(0, 0, 0.6), &sphere);
  btCollisionShape* const shapes[] = {ring.get(), &sphere, &box, &compound};
  DynamicWorld dynamic;
  dynamic.world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  dynamic.add(*floor, 0, at(0, 0, 0));
  std::mt19937_64 random(75);
  for (int i = 0; i < 60; ++i) {
    const Vec3 place(2.2 * (i % 5 - 2), 2.2 * (i / 5 % 4 - 1.5), 2.5 + 2.2 * (i / 20));
    btTransform pose = toBullet(Pose{testing::randomRotation(random), place});
    dynamic.add(*shapes[random() % 4], 1, pose);
  }
  int most_apart = 0;
  for (int step = 0; step < 360; ++step) {
    dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
    most_apart = std::max(most_apart, dynamic.broadphase.coarsePairs() - dynamic.broadphase.tightPairs());
  }
  EXPECT_GT(most_apart, 10);
  int fallen = 0;
  for (std::size_t i = 1; i < dynamic.bodies.size(); ++i) {
    const Vec3 place = fromBullet(dynamic.bodies[i]->getWorldTransform().getOrigin());
    const bool over_the_floor = std::abs(place.x()) < 9.5 && std::abs(place.y()) < 9.5;
    EXPECT_TRUE(!over_the_floor || place.z() > -0.4) << "body " << i << " at " << place.transpose();
    fallen += over_the_floor && place.z() < 2.0;
  }
  EXPECT_GT(fallen, 40);
}

TEST(BroadphaseWorld, whatIsInARingIsNoIslandWithIt) {
  const auto torus = shapeOf(testing::torus(2, 0.5, 48, 24));
  btSphereShape sphere(btScalar(0.5));
  DynamicWorld dynamic;
  dynamic.world.setGravity(btVector3(0, 0, 0));
  const btRigidBody& ring = dynamic.add(*torus, 1, at(0, 0, 0));
  btRigidBody& ball = dynamic.add(sphere, 1, at(0, 0, 0));
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_NE(ring.getIslandTag(), ball.getIslandTag());
  ball.setWorldTransform(at(1.2, 0, 0));
  ball.setInterpolationWorldTransform(at(1.2, 0, 0));
  dynamic.world.stepSimulation(btScalar(1.0 / 240.0), 0);
  EXPECT_EQ(ring.getIslandTag(), ball.getIslandTag());
}

}  // namespace
}  // namespace octoblisk
