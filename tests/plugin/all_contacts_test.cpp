// Compares all contacts of a pair, from the dispatcher's algorithm, with a brute-force search over every
// triangle pair.
#include "octoblisk_bullet/all_contacts.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <gtest/gtest.h>

#include <random>

#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/brute_force.h"

namespace octoblisk {
namespace {

using testing::BulletWorld;

/// Two bodies, and the dispatcher's algorithm for them in one order.
class DispatchedPair {
 public:
  DispatchedPair(BulletWorld& world, btCollisionObject& first, btCollisionObject& second)
      : world_(world), first_(first), second_(second) {
    const btCollisionObjectWrapper a = wrapOf(first_), b = wrapOf(second_);
    algorithm_ = world_.dispatcher().findAlgorithm(&a, &b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
  }
  ~DispatchedPair() {
    algorithm_->~btCollisionAlgorithm();
    world_.dispatcher().freeCollisionAlgorithm(algorithm_);
  }
  DispatchedPair(const DispatchedPair&) = delete;
  DispatchedPair& operator=(const DispatchedPair&) = delete;

  /// Returns A, and the contacts in A's frame.
  std::pair<const btCollisionObject*, std::vector<Contact>> contacts() {
    const btCollisionObjectWrapper a = wrapOf(first_), b = wrapOf(second_);
    AllContacts all(&a, &b);
    algorithm_->processCollision(&a, &b, world_->getDispatchInfo(), &all);
    return {all.a(), {all.contacts().begin(), all.contacts().end()}};
  }

  /// Detects contacts as a step of the world does.
  void step() {
    const btCollisionObjectWrapper a = wrapOf(first_), b = wrapOf(second_);
    btManifoldResult result(&a, &b);
    algorithm_->processCollision(&a, &b, world_->getDispatchInfo(), &result);
  }

  /// The distances in the manifolds.
  std::vector<double> distances() {
    btManifoldArray manifolds;
    algorithm_->getAllContactManifolds(manifolds);
    std::vector<double> found;
    for (int i = 0; i < manifolds.size(); ++i) {
      for (int p = 0; p < manifolds[i]->getNumContacts(); ++p)
        found.push_back(double(manifolds[i]->getContactPoint(p).getDistance()));
    }
    return found;
  }

 private:
  static btCollisionObjectWrapper wrapOf(const btCollisionObject& object) {
    return {nullptr, object.getCollisionShape(), &object, object.getWorldTransform(), -1, -1};
  }

  BulletWorld& world_;
  btCollisionObject &first_, &second_;
  btCollisionAlgorithm* algorithm_;
};

TEST(AllContacts, ofTwoOfOurShapes_vs_bruteforce) {
  const auto fan = testing::fan(5, 8), torus = testing::torus(0.6, 0.2, 20, 10);
  ClusteredOctreeShape fan_shape = shapeOver(fan), torus_shape = shapeOver(torus);
  constexpr double kReach = 0.03;
  for (ClusteredOctreeShape* const shape : {&fan_shape, &torus_shape}) {
    shape->setContactBreakingThreshold(btScalar(kReach));
  }
  BulletWorld world;
  btCollisionObject still, moving;
  still.setCollisionShape(&fan_shape);
  moving.setCollisionShape(&torus_shape);
  DispatchedPair pair(world, still, moving);
  std::mt19937_64 random(61);
  int hits = 0, patches = 0;
  constexpr int kPoses = 150;
  for (int i = 0; i < kPoses; ++i) {
    still.setWorldTransform(toBullet(testing::randomPose(random, 0.3)));
    moving.setWorldTransform(toBullet(testing::randomPose(random, 1.2)));
    const Pose moving_in_still =
        fromBullet(still.getWorldTransform()).inverse() * fromBullet(moving.getWorldTransform());
    const auto [a, found] = pair.contacts();
    ASSERT_EQ(a, &still);
    const auto expected =
        testing::bruteForceContacts(*fan, *torus, moving_in_still, double(btScalar(kReach)));
    ASSERT_EQ(found.size(), expected.size()) << "pose " << i;
    for (std::size_t c = 0; c < found.size(); ++c) {
      ASSERT_EQ(found[c].triangle_a, expected[c].triangle_a);
      ASSERT_EQ(found[c].triangle_b, expected[c].triangle_b);
      ASSERT_NEAR(found[c].distance, expected[c].distance, 1e-9);
    }
    hits += !found.empty();
    patches += found.size() > 4;
    ASSERT_TRUE(pair.distances().empty()) << "the manifolds must stay unchanged";
  }
  EXPECT_GT(hits, 3 * kPoses / 10);
  EXPECT_LT(hits, 7 * kPoses / 10);
  EXPECT_GT(patches, hits / 2) << "more than a manifold keeps";
}

// The next step must still notice that the other shape has changed.
TEST(AllContacts, hideNoChangeFromAStep) {
  ClusteredOctreeShape floor = shapeOver(testing::boxMesh({9, 9, 1}));
  btSphereShape sphere(2);
  BulletWorld world;
  btCollisionObject still, ball;
  still.setCollisionShape(&floor);
  ball.setCollisionShape(&sphere);
  ball.setWorldTransform(testing::at(0.3, 0.2, 2.99));
  DispatchedPair pair(world, still, ball);
  pair.step();
  ASSERT_EQ(pair.distances().size(), 1u);
  EXPECT_NEAR(pair.distances().front(), -0.01, 1e-5);
  sphere.setUnscaledRadius(btScalar(2.2));
  pair.contacts();
  pair.step();
  ASSERT_EQ(pair.distances().size(), 1u);
  EXPECT_NEAR(pair.distances().front(), -0.21, 1e-5);
}

/// A shape over a partitioned mesh, with the blades of a fan as its parts.
ClusteredOctreeShape shapeOf(const testing::SharedMesh& mesh, BuildOptions options, int parts) {
  options.part_of_triangle.resize(mesh->triangleCount());
  for (std::size_t t = 0; t < mesh->triangleCount(); ++t) {
    options.part_of_triangle[t] =
        static_cast<int>(t * static_cast<std::size_t>(parts) / mesh->triangleCount());
  }
  ClusteredOctreeShape shape(treeOver(mesh, options));
  shape.setMargin(0);
  return shape;
}

TEST(AllContacts, areTheSameOfEveryPartition) {
  constexpr int kBlades = 5, kOptimal = 0;
  const auto fan = testing::fan(kBlades, 8), torus = testing::torus(0.6, 0.2, 20, 10);
  ClusteredOctreeShape fan_shape = shapeOver(fan), torus_shape = shapeOver(torus);
  std::vector<ClusteredOctreeShape> fans, tori;
  for (const int k : {1, 2, 8, kOptimal}) {
    const BuildOptions options{.partition = PartitionKind::paper, .clusters = k};
    fans.push_back(shapeOf(fan, options, kBlades));
    tori.push_back(shapeOf(torus, options, 1));
  }
  BulletWorld world;
  std::mt19937_64 random(62);
  int hits = 0;
  constexpr int kPoses = 60;
  for (int i = 0; i < kPoses; ++i) {
    const btTransform pose = toBullet(testing::randomPose(random, 1.2));
    const auto contactsOf = [&](ClusteredOctreeShape& still_shape, ClusteredOctreeShape& moving_shape) {
      btCollisionObject still, moving;
      still.setCollisionShape(&still_shape);
      moving.setCollisionShape(&moving_shape);
      moving.setWorldTransform(pose);
      return DispatchedPair(world, still, moving).contacts().second;
    };
    const std::vector<Contact> expected = contactsOf(fan_shape, torus_shape);
    hits += !expected.empty();
    for (std::size_t k = 0; k < fans.size(); ++k) {
      const std::vector<Contact> found = contactsOf(fans[k], tori[k]);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t c = 0; c < found.size(); ++c) {
        ASSERT_EQ(found[c].triangle_a, expected[c].triangle_a);
        ASSERT_EQ(found[c].triangle_b, expected[c].triangle_b);
        ASSERT_EQ(found[c].distance, expected[c].distance);
        ASSERT_EQ(found[c].normal, expected[c].normal);
        ASSERT_EQ(found[c].point_on_a, expected[c].point_on_a);
      }
    }
  }
  EXPECT_GT(hits, 3 * kPoses / 10);
  EXPECT_LT(hits, 7 * kPoses / 10);
}

TEST(AllContacts, ofAConvexShapeInEitherOrderAreInTheMeshsFrame) {
  const auto sheet = testing::waveSheet(2, 0.0, 8);
  ClusteredOctreeShape sheet_shape = shapeOver(sheet);
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  box.setMargin(btScalar(0.01));
  BulletWorld world;
  btCollisionObject mesh, convex;
  mesh.setCollisionShape(&sheet_shape);
  convex.setCollisionShape(&box);
  mesh.setWorldTransform(testing::at(0, 0, 7));
  convex.setWorldTransform(testing::at(0, 0, btScalar(7.49)));
  for (const bool mesh_first : {true, false}) {
    DispatchedPair pair(world, mesh_first ? mesh : convex, mesh_first ? convex : mesh);
    const auto [a, found] = pair.contacts();
    EXPECT_EQ(a, &mesh);
    EXPECT_GT(found.size(), 4u) << "one for each triangle below";
    for (const Contact& contact : found) {
      EXPECT_NEAR(contact.point_on_a.z(), 0.0, 1e-5);
    }
    EXPECT_NEAR(testing::deepest(found), -0.01, 1e-5);
  }
}

}  // namespace
}  // namespace octoblisk
