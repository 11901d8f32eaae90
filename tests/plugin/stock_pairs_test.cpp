// The table of docs/bullet.md: the pairs of a moving concave body that the plugin's shape and Bullet's own
// shapes find.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <gtest/gtest.h>

#include "plugin/bullet_world.h"
#include "plugin/partners.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;
using testing::BulletWorld;
using testing::Made;
using testing::PairReport;
using testing::Partner;

/// The number of poses at which the plugin's shape touches, and the number found by a world's contacts and by
/// contactPairTest in both orders.
struct Found {
  int touching = 0, in_world = 0, by_pair_test = 0;
};

Found found(btCollisionShape& mover, const Partner& partner) {
  const Made made = partner.make();
  const auto torus = testing::torus(2, 0.7, 24, 12);
  BulletMesh source(*torus);
  ClusteredOctreeShape ours(source.view());
  std::mt19937_64 random(73);
  Found sum;
  for (int i = 0; i < 40; ++i) {
    btCollisionObject moving, other, reference;
    moving.setCollisionFlags(0);
    moving.setCollisionShape(&mover);
    other.setCollisionShape(made.shape.get());
    reference.setCollisionShape(&ours);
    moving.setWorldTransform(toBullet(testing::randomPose(random, partner.spread)));
    reference.setWorldTransform(moving.getWorldTransform());
    other.setWorldTransform(toBullet(testing::randomPose(random, 1.0)));
    BulletWorld world;
    PairReport expected;
    world->contactPairTest(&reference, &other, expected);
    if (expected.deepest() > -0.02) continue;  // beyond doubt
    ++sum.touching;
    // Registers GImpact first, as both require.
    btGImpactCollisionAlgorithm::registerAlgorithm(&world.dispatcher());
    registerAlgorithm(&world.dispatcher());
    PairReport report, swapped;
    world->contactPairTest(&moving, &other, report);
    world->contactPairTest(&other, &moving, swapped);
    EXPECT_EQ(report.points.empty(), swapped.points.empty());
    sum.by_pair_test += !report.points.empty();
    btCollisionObject* objects[] = {&moving, &other};
    if (i % 2) std::swap(objects[0], objects[1]);
    for (btCollisionObject* object : objects) world->addCollisionObject(object, 1, -1);
    world->performDiscreteCollisionDetection();
    sum.in_world += world.contactPoints() > 0;
    for (btCollisionObject* object : objects) world->removeCollisionObject(object);
  }
  EXPECT_GT(sum.touching, 5);
  return sum;
}

std::vector<Partner> partners() {
  std::vector<Partner> all = testing::concavePartners();
  std::erase_if(all,
                [](const Partner& partner) { return partner.name == "ours" || partner.name == "foreign"; });
  for (Partner& convex : testing::convexPartners()) all.push_back(std::move(convex));
  return all;
}

class StockPairs : public ::testing::TestWithParam<Partner> {
 protected:
  StockPairs() : source(*testing::torus(2, 0.7, 24, 12)), bvh(source.view(), true), gimpact(source.view()) {
    gimpact.updateBound();
  }
  static bool isConcave() {
    const Made made = GetParam().make();
    return made.mesh || made.half_space;
  }

  BulletMesh source;
  btBvhTriangleMeshShape bvh;
  btGImpactMeshShape gimpact;
};

TEST_P(StockPairs, oursFindsAll) {
  ClusteredOctreeShape ours(source.view());
  const Found sum = found(ours, GetParam());
  EXPECT_EQ(sum.in_world, sum.touching);
  EXPECT_EQ(sum.by_pair_test, sum.touching);
}

TEST_P(StockPairs, bvhFindsConvexBodiesAlone) {
  const Found sum = found(bvh, GetParam());
  if (!isConcave()) {
    EXPECT_EQ(sum.in_world, sum.touching);
    EXPECT_EQ(sum.by_pair_test, sum.touching);
    return;
  }
  EXPECT_EQ(sum.by_pair_test, 0);
  if (GetParam().name.starts_with("gimpact")) {
    EXPECT_GT(sum.in_world, 0);  // found by GImpact's algorithm
  } else {
    EXPECT_EQ(sum.in_world, 0);
  }
}

TEST_P(StockPairs, gimpactFindsConcaveBodiesInWorldsAlone) {
  const Found sum = found(gimpact, GetParam());
  EXPECT_GT(sum.in_world, sum.touching * 9 / 10);
  if (isConcave()) {
    EXPECT_EQ(sum.by_pair_test, 0);
  } else {
    EXPECT_EQ(sum.by_pair_test, sum.touching);
  }
}

INSTANTIATE_TEST_SUITE_P(PairMatrix, StockPairs, ::testing::ValuesIn(partners()),
                         [](const auto& partner) { return partner.param.name; });

/// The height of the lowest node of a cloth dropped on a floor at 0.
double clothOn(btCollisionShape& shape) {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  registerAlgorithm(&dispatcher);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, btScalar(-9.81)));
  world.getWorldInfo().m_gravity = world.getGravity();
  btRigidBody body(0, nullptr, &shape);
  world.addRigidBody(&body);
  const auto corner = [](double x, double y) { return toBullet(Vec3(x, y, 1.0)); };
  btSoftBody* cloth = btSoftBodyHelpers::CreatePatch(world.getWorldInfo(), corner(-1, -1), corner(1, -1),
                                                     corner(-1, 1), corner(1, 1), 9, 9, 0, true);
  cloth->setTotalMass(1);
  world.addSoftBody(cloth);
  for (int i = 0; i < 480; ++i) world.stepSimulation(btScalar(1.0 / 240.0), 0);
  double lowest = 1e9;
  for (int n = 0; n < cloth->m_nodes.size(); ++n)
    lowest = std::min(lowest, double(cloth->m_nodes[n].m_x.z()));
  world.removeSoftBody(cloth);
  delete cloth;
  world.removeRigidBody(&body);
  return lowest;
}

TEST(StockCloth, fallsThroughGImpactAlone) {
  BulletMesh source(*testing::waveSheet(4, 0.0, 16));
  ClusteredOctreeShape ours(source.view());
  btBvhTriangleMeshShape bvh(source.view(), true);
  btGImpactMeshShape gimpact(source.view());
  gimpact.updateBound();
  EXPECT_GT(clothOn(ours), -0.1);
  EXPECT_GT(clothOn(bvh), -0.1);
  EXPECT_LT(clothOn(gimpact), -5.0);
}

}  // namespace
}  // namespace octoblisk
