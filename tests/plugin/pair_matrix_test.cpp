// The plugin's shape against every kind of shape: both orders, both tables, and worlds.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "plugin/bullet_world.h"
#include "plugin/partners.h"
#include "plugin/shape_over.h"
#include "shared/body_contacts.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::at;
using testing::BulletMesh;
using testing::BulletWorld;
using testing::Made;
using testing::PairReport;
using testing::Partner;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoise = sizeof(btScalar) == 4 ? 1e-5 : 1e-12;  // of posed coordinates

const testing::SharedMesh& torusMesh() {
  static const testing::SharedMesh mesh = testing::rounded(*testing::torus(2, 0.7, 24, 12));
  return mesh;
}

std::vector<Partner> allPartners() {
  std::vector<Partner> all = testing::concavePartners();
  for (Partner& convex : testing::convexPartners()) all.push_back(std::move(convex));
  return all;
}

std::vector<Partner> floors() {
  std::vector<Partner> all = allPartners();
  std::erase_if(all, [](const Partner& partner) { return !partner.floor; });
  return all;
}

const auto kName = [](const auto& partner) { return partner.param.name; };

/// A torus of the plugin's shape as body 0, and the partner.
struct Pair {
  explicit Pair(const Partner& partner) : made(partner.make()), random(71) {
    torus_object.setCollisionShape(&torus);
    other_object.setCollisionShape(made.shape.get());
    spread = partner.spread;
  }
  void poseAtRandom() {
    torus_object.setWorldTransform(toBullet(testing::randomPose(random, spread)));
    other_object.setWorldTransform(toBullet(testing::randomPose(random, 1.0)));
    world_torus = fromBullet(torus_object.getWorldTransform());
    other_in_torus = world_torus.inverse() * fromBullet(other_object.getWorldTransform());
  }

  ClusteredOctreeShape torus = shapeOver(torusMesh());
  Made made;
  std::mt19937_64 random;
  double spread;
  btCollisionObject torus_object, other_object;
  Pose world_torus, other_in_torus;
};

void expectMirrored(const PairReport& report, const PairReport& swapped) {
  ASSERT_EQ(report.points.size(), swapped.points.size());
  for (std::size_t p = 0; p < swapped.points.size(); ++p) {
    const auto &a = report.points[p], &b = swapped.points[p];
    ASSERT_EQ(a.distance, b.distance);
    ASSERT_LT((a.normal + b.normal).norm(), kNoise);
    ASSERT_LT((a.on_a - b.on_b).norm(), kNoise);
    ASSERT_EQ(a.index0, b.index1);
    ASSERT_EQ(a.part0, b.part1);
    ASSERT_EQ(a.index1, b.index0);
    ASSERT_EQ(a.part1, b.part0);
  }
}

class ConcavePairs : public ::testing::TestWithParam<Partner> {};

TEST_P(ConcavePairs, contacts_vs_bruteforce) {
  Pair pair(GetParam());
  pair.torus.setSolid(false);  // only contacts of triangles
  BulletWorld world;
  int hits = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    pair.poseAtRandom();
    // Both have margins. A plane's margin is ignored, as with Bullet's convex shapes.
    const double margin = i % 2 ? 0.05 : 0.0, other_margin = i % 2 ? 0.03 : 0.0;
    pair.torus.setMargin(btScalar(margin));
    pair.made.setMargin(other_margin);
    const double margins = margin + (pair.made.half_space ? 0.0 : other_margin);
    const double threshold = double(gContactBreakingThreshold) + margins;
    PairReport report, swapped;
    world->contactPairTest(&pair.torus_object, &pair.other_object, report);
    world->contactPairTest(&pair.other_object, &pair.torus_object, swapped);
    hits += !report.points.empty();
    if (report.points.empty()) {
      ASSERT_TRUE(swapped.points.empty());
    } else {
      ASSERT_NEAR(swapped.deepest(), report.deepest(), kNoise);
    }
    // With two bodies of the plugin's shape, the result is in the first one's frame.
    if (GetParam().name != "ours") {
      ASSERT_NO_FATAL_FAILURE(expectMirrored(report, swapped)) << "pose " << i;
    }
    for (const PairReport::Point& point : report.points) ASSERT_EQ(point.part0, 0);
    if (pair.made.mesh) {
      std::vector<Contact> found = report.contacts(pair.world_torus, margin, other_margin);
      for (std::size_t c = 0; c < found.size(); ++c) {
        const PairReport::Point& point = report.points[c];
        const auto id = std::ranges::find_if(pair.made.ids, [&](const TriangleId& triangle) {
          return triangle.part == point.part1 && triangle.index == point.index1;
        });
        ASSERT_NE(id, pair.made.ids.end());
        found[c].triangle_b = static_cast<std::uint32_t>(id - pair.made.ids.begin());
      }
      ASSERT_EQ(testing::faultOfContacts(*torusMesh(), *pair.made.mesh, pair.other_in_torus, threshold,
                                         threshold / 40.0, 20 * kNoise, found),
                "")
          << "pose " << i;
      continue;
    }
    const HalfSpace& plane = *pair.made.half_space;
    const Pose torus_in_plane = pair.other_in_torus.inverse();
    double deepest = kInfinity;
    for (const Vec3& corner : torusMesh()->vertices())
      deepest = std::min(deepest, plane.normal.dot(torus_in_plane * corner) - plane.offset);
    ASSERT_EQ(report.points.empty(), deepest > threshold) << "pose " << i;
    if (report.points.empty()) continue;
    ASSERT_NEAR(report.deepest(), deepest - margins, kNoise) << "pose " << i;
    for (const PairReport::Point& point : report.points) {
      ASSERT_EQ(point.index1, -1);
      const Vec3 on_torus = pair.world_torus.inverse() * (point.on_a + margin * point.normal);
      const double height = plane.normal.dot(torus_in_plane * on_torus) - plane.offset;
      ASSERT_NEAR(height - margins, point.distance, 2 * kNoise);
      ASSERT_LT(testing::bruteForceDistance(torusMesh()->triangle(std::size_t(point.index0)), on_torus),
                2 * kNoise);
    }
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

TEST_P(ConcavePairs, closestPointsReachAsFarAsAsked) {
  if (!GetParam().floor) GTEST_SKIP();
  const Made made = GetParam().floor();
  auto box = shapeOver(testing::boxMesh({0.5, 0.5, 0.5}));
  btCollisionObject a, b;
  a.setCollisionShape(&box);
  b.setCollisionShape(made.shape.get());
  a.setWorldTransform(at(0.1, 0.2, 1.25));
  BulletWorld world;
  PairReport near, far;
  near.m_closestDistanceThreshold = btScalar(0.7);
  far.m_closestDistanceThreshold = btScalar(0.8);
  world->contactPairTest(&a, &b, near);
  world->contactPairTest(&b, &a, far);
  EXPECT_TRUE(near.points.empty());
  EXPECT_NEAR(far.deepest(), 0.75, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, ConcavePairs, ::testing::ValuesIn(testing::concavePartners()), kName);

class ConvexPartners : public ::testing::TestWithParam<Partner> {};

TEST_P(ConvexPartners, contacts_vs_bvh) {
  Pair pair(GetParam());
  pair.torus.setSolid(false);  // like btBvhTriangleMeshShape
  BulletMesh source(*torusMesh());
  btBvhTriangleMeshShape bvh(source.view(), true);
  btCollisionObject bvh_object;
  bvh_object.setCollisionShape(&bvh);
  BulletWorld world;
  int hits = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    pair.poseAtRandom();
    bvh_object.setWorldTransform(pair.torus_object.getWorldTransform());
    PairReport report, swapped, of_bvh;
    world->contactPairTest(&pair.torus_object, &pair.other_object, report);
    world->contactPairTest(&pair.other_object, &pair.torus_object, swapped);
    world->contactPairTest(&bvh_object, &pair.other_object, of_bvh);
    const bool hit = report.deepest() <= 0.0;
    hits += hit;
    EXPECT_EQ(report.points.size(), swapped.points.size());
    EXPECT_TRUE(report.points.empty() || report.deepest() == swapped.deepest());
    if (std::min(std::abs(report.deepest()), std::abs(of_bvh.deepest())) < 1e-3) continue;
    EXPECT_EQ(hit, of_bvh.deepest() <= 0.0)
        << "pose " << i << ": " << report.deepest() << ", " << of_bvh.deepest();
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, ConvexPartners, ::testing::ValuesIn(testing::convexPartners()), kName);

class AllPairs : public ::testing::TestWithParam<Partner> {};

TEST_P(AllPairs, worldsFindWhatPairTestsFind) {
  // The other table, and the broadphase. A pair has the order in which its bodies were added.
  Pair pair(GetParam());
  const auto breaking = [](const btCollisionObject& object) {
    return double(object.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold));
  };
  const double half_breaking =
      0.5 * std::min(breaking(pair.torus_object), breaking(pair.other_object)) - kNoise;
  int hits = 0;
  constexpr int kPoses = 60;
  for (int i = 0; i < kPoses; ++i) {
    pair.poseAtRandom();
    BulletWorld world;
    PairReport expected;
    world->contactPairTest(&pair.torus_object, &pair.other_object, expected);
    hits += !expected.points.empty();
    btCollisionObject* objects[] = {&pair.torus_object, &pair.other_object};
    if (i % 2) std::swap(objects[0], objects[1]);
    for (btCollisionObject* object : objects) world->addCollisionObject(object, 1, -1);
    world->performDiscreteCollisionDetection();
    double deepest = kInfinity;
    for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher()))
      deepest = std::min(deepest, double(point->getDistance()));
    PairReport tested;
    world->contactTest(objects[i / 2 % 2], tested);
    for (btCollisionObject* object : objects) world->removeCollisionObject(object);
    ASSERT_EQ(world.dispatcher().getNumManifolds(), 0);
    ASSERT_EQ(tested.points.empty(), expected.points.empty()) << "pose " << i;
    if (expected.points.empty()) continue;
    ASSERT_NEAR(tested.deepest(), expected.deepest(), 10 * kNoise) << "pose " << i;
    // In a step, contacts are created within half the breaking threshold.
    if (expected.deepest() > half_breaking) continue;
    if (expected.deepest() < -half_breaking) {  // edges that overlap more do not decide
      ASSERT_LE(deepest, -half_breaking) << "pose " << i;
    } else {
      ASSERT_NEAR(deepest, expected.deepest(), 10 * kNoise) << "pose " << i;
    }
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, AllPairs, ::testing::ValuesIn(allPartners()), kName);

class Floors : public ::testing::TestWithParam<Partner> {};

TEST_P(Floors, ourBodiesComeToRest) {
  const Made floor = GetParam().floor();
  auto box = shapeOver(testing::boxMesh({0.5, 0.4, 0.3}));
  auto ring = shapeOver(testing::torus(0.6, 0.25, 24, 12));
  BulletWorld world;
  world.add(*floor.shape, 0, at(0, 0, 0));
  const btTransform tilted(btQuaternion(btVector3(1, 0, 0), btScalar(0.3)), btVector3(-1, 0, 1));
  btRigidBody& brick = world.add(box, 1, tilted);
  btRigidBody& lying = world.add(ring, 1, at(1, 0.1, 0.7));
  world.step(240 * 4);
  const auto height = [](const btRigidBody& body) {
    return double(body.getWorldTransform().getOrigin().z());
  };
  EXPECT_NEAR(height(brick), 0.3, 0.02);
  EXPECT_NEAR(height(lying), 0.25, 0.02);
  EXPECT_LT(double(brick.getLinearVelocity().length()), 0.05);
  EXPECT_LT(double(lying.getLinearVelocity().length()), 0.05);
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, Floors, ::testing::ValuesIn(floors()), kName);

TEST(Plane, deepBodiesComeOut) {
  // At any depth, because a plane is a half-space.
  auto box = shapeOver(testing::boxMesh({1, 1, 1}));
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  BulletWorld world;
  world.add(plane, 0, at(0, 0, 0));
  PairReport report;
  btRigidBody& body = world.add(box, 1, at(0, 0, -50));
  world->contactPairTest(&body, world->getCollisionObjectArray()[0], report);
  EXPECT_NEAR(report.deepest(), -51.0, 1e-4);
  world.step(240 * 10);
  EXPECT_GT(double(body.getWorldTransform().getOrigin().z()), 0.9);
}

/// The deepest contact of a torus of the plugin's shape and a GImpact shape, in both orders and in a world.
struct GImpactContacts {
  double first, second, in_world;
};

GImpactContacts gimpactContacts(BulletWorld& world, btGImpactShapeInterface& gimpact) {
  auto torus = shapeOver(torusMesh());
  gimpact.updateBound();
  btCollisionObject a, b;
  a.setCollisionShape(&torus);
  b.setCollisionShape(&gimpact);
  b.setWorldTransform(at(2, 0, 1));
  PairReport first, second;
  world->contactPairTest(&a, &b, first);
  world->contactPairTest(&b, &a, second);
  for (btCollisionObject* object : {&a, &b}) world->addCollisionObject(object, 1, -1);
  world->performDiscreteCollisionDetection();
  double in_world = kInfinity;
  for (const btManifoldPoint* point : testing::manifoldPoints(world.dispatcher()))
    in_world = std::min(in_world, double(point->getDistance()));
  for (btCollisionObject* object : {&a, &b}) world->removeCollisionObject(object);
  return {first.deepest(), second.deepest(), in_world};
}

TEST(GImpact, theLastRegistrationWins) {
  BulletMesh source(*testing::boxMesh({0.5, 0.5, 0.5}));
  btGImpactMeshShape box(source.view());
  BulletWorld without;
  const GImpactContacts ours = gimpactContacts(without, box);
  EXPECT_LT(ours.first, 0.0);
  EXPECT_NEAR(ours.second, ours.first, kNoise);
  EXPECT_NEAR(ours.in_world, ours.first, kNoise);

  BulletWorld ours_last;
  btGImpactCollisionAlgorithm::registerAlgorithm(&ours_last.dispatcher());
  registerAlgorithm(&ours_last.dispatcher());
  const GImpactContacts after = gimpactContacts(ours_last, box);
  EXPECT_EQ(after.first, ours.first);
  EXPECT_EQ(after.second, ours.second);
  EXPECT_EQ(after.in_world, ours.in_world);

  // GImpact registers in the table of contacts, not in that of closest points.
  BulletWorld gimpact_last;
  btGImpactCollisionAlgorithm::registerAlgorithm(&gimpact_last.dispatcher());
  const GImpactContacts before = gimpactContacts(gimpact_last, box);
  EXPECT_EQ(before.first, ours.first);
  EXPECT_EQ(before.second, ours.second);
  EXPECT_LT(before.in_world, 0.0);
}

TEST(GImpact, compoundsAreLeftToGImpact) {
  btBoxShape box(toBullet(Vec3(0.5, 0.5, 0.5)));
  btGImpactCompoundShape compound;
  compound.addChildShape(btTransform::getIdentity(), &box);
  BulletWorld world;
  const GImpactContacts found = gimpactContacts(world, compound);
  EXPECT_LT(found.first, 0.0);
  EXPECT_LT(found.second, 0.0);
  EXPECT_LT(found.in_world, 0.0);
}

TEST(GImpact, itsOwnPairsStayAsTheyAre) {
  BulletMesh source(*testing::boxMesh({0.5, 0.5, 0.5}));
  btGImpactMeshShape box(source.view());
  box.updateBound();
  BulletWorld world;
  btGImpactCollisionAlgorithm::registerAlgorithm(&world.dispatcher());
  registerAlgorithm(&world.dispatcher());
  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  world.add(plane, 0, at(0, 0, 0));
  btRigidBody& body = world.add(box, 1, at(0, 0, 1));
  world.step(480);
  EXPECT_NEAR(double(body.getWorldTransform().getOrigin().z()), 0.5, 0.05);
}

}  // namespace
}  // namespace octoblisk
