// btDiscreteDynamicsWorldMt, on a Bullet with BT_THREADSAFE: the same contacts as in the plain world, on any
// number of threads. ./dev mt also runs these tests under the thread sanitizer.
#include <LinearMath/btPoolAllocator.h>
#include <LinearMath/btThreads.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "mt/bodies_on_blisk.h"
#include "octoblisk_bullet/clustered_octree_broadphase.h"
#include "octoblisk_bullet/motion_clamping.h"

namespace octoblisk {
namespace {

using bench::BodiesOnBlisk;
using bench::ShapeKind;
using bench::WorldKind;

constexpr int kBodies = 1000;

std::unique_ptr<BodiesOnBlisk> makeWorld(WorldKind kind, bool has_clusters) {
  std::unique_ptr<btBroadphaseInterface> broadphase = std::make_unique<btDbvtBroadphase>();
  if (has_clusters) broadphase = std::make_unique<ClusteredOctreeBroadphase>();
  return std::make_unique<BodiesOnBlisk>(kind, ShapeKind::octoblisk, kBodies, std::move(broadphase));
}

/// Everything that is known about a contact point, but impulses.
using Point = std::array<double, 16>;

/// All contact points of a world in an order that does not depend on that of the manifolds.
std::vector<Point> contactsOf(BodiesOnBlisk& scene) {
  std::vector<Point> found;
  btDispatcher& dispatcher = *scene.world().getDispatcher();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const btManifoldPoint& at = manifold.getContactPoint(p);
      const btVector3 &a = at.m_localPointA, &b = at.m_localPointB, &normal = at.m_normalWorldOnB;
      found.push_back({double(manifold.getBody0()->getWorldArrayIndex()),
                       double(manifold.getBody1()->getWorldArrayIndex()), double(at.m_partId0),
                       double(at.m_index0), double(at.m_partId1), double(at.m_index1), double(a.x()),
                       double(a.y()), double(a.z()), double(b.x()), double(b.y()), double(b.z()),
                       double(normal.x()), double(normal.y()), double(normal.z()), double(at.m_distance1)});
    }
  }
  std::ranges::sort(found);
  return found;
}

void copyMotions(const BodiesOnBlisk& from, const BodiesOnBlisk& to) {
  for (std::size_t i = 0; i < from.moving().size(); ++i) {
    const btRigidBody& source = *from.moving()[i];
    btRigidBody& body = *to.moving()[i];
    body.setCenterOfMassTransform(source.getCenterOfMassTransform());
    body.setLinearVelocity(source.getLinearVelocity());
    body.setAngularVelocity(source.getAngularVelocity());
  }
}

/// Gives a few of the concave bodies another shape, so that their algorithms make and delete others of the
/// dispatcher's pool.
void exchangeShapes(const BodiesOnBlisk& scene, int step, btCollisionShape& shape) {
  for (std::size_t i = 1 + 2 * static_cast<std::size_t>(step); i < scene.moving().size(); i += 200)
    scene.moving()[i]->setCollisionShape(&shape);
}

struct Case {
  int threads;
  bool has_clusters;
};

class ParallelWorld : public ::testing::TestWithParam<Case> {
 protected:
  ParallelWorld() { bench::useThreads(GetParam().threads); }
};

TEST_P(ParallelWorld, hasTheContactsOfThePlainWorld) {
  constexpr int kSteps = 40, kExchanges = 20;
  btBoxShape box(btVector3(4, 4, 4));
  const auto plain = makeWorld(WorldKind::plain, GetParam().has_clusters),
             parallel = makeWorld(WorldKind::parallel, GetParam().has_clusters);
  std::size_t most = 0;
  for (int step = 0; step < kSteps; ++step) {
    copyMotions(*plain, *parallel);
    if (step >= kSteps - kExchanges) {
      for (const auto* scene : {plain.get(), parallel.get()})
        exchangeShapes(*scene, step - (kSteps - kExchanges), box);
    }
    plain->step();
    parallel->step();
    const std::vector<Point> expected = contactsOf(*plain);
    ASSERT_EQ(contactsOf(*parallel), expected) << "step " << step;
    most = std::max(most, expected.size());
  }
  EXPECT_GT(most, 2000u);
  for (BodiesOnBlisk* scene : {plain.get(), parallel.get()}) {
    for (const auto& body : scene->moving()) scene->world().removeRigidBody(body.get());
    EXPECT_EQ(scene->world().getDispatcher()->getNumManifolds(), 0);
    EXPECT_EQ(scene->configuration().getPersistentManifoldPool()->getUsedCount(), 0);
    EXPECT_EQ(scene->configuration().getCollisionAlgorithmPool()->getUsedCount(), 0);
  }
}

TEST_P(ParallelWorld, losesNoBody) {
  const auto scene = makeWorld(WorldKind::parallel, GetParam().has_clusters);
  MotionClamping clamping;
  scene->world().addAction(&clamping);
  scene->world().getDispatchInfo().m_useContinuous = false;
  for (const auto& body : scene->moving()) body->setCcdMotionThreshold(2);
  for (int step = 0; step < 40; ++step) scene->step();
  EXPECT_EQ(scene->lost(), 0);
  scene->world().removeAction(&clamping);
}

/// Rays and sweeps down through the world, each on any thread.
struct Casts final : btIParallelForBody {
  Casts(const btCollisionWorld& in, int count) : world(in), fractions(static_cast<std::size_t>(count)) {}
  void forLoop(int begin, int end) const override {
    const btSphereShape ball(2);
    for (int i = begin; i < end; ++i) {
      const btVector3 from(btScalar(-240 + i % 48 * 10), btScalar(-240 + i / 48 * 10), 200);
      const btVector3 to = from - btVector3(0, 0, 400);
      btCollisionWorld::ClosestRayResultCallback ray(from, to);
      world.rayTest(from, to, ray);
      btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
      world.convexSweepTest(&ball, btTransform(btQuaternion::getIdentity(), from),
                            btTransform(btQuaternion::getIdentity(), to), sweep);
      fractions[static_cast<std::size_t>(i)] = {ray.m_closestHitFraction, sweep.m_closestHitFraction};
    }
  }

  const btCollisionWorld& world;
  mutable std::vector<std::array<btScalar, 2>> fractions;
};

TEST_P(ParallelWorld, castsOfAllThreadsHitAsThoseOfOne) {
  constexpr int kCasts = 48 * 48;
  const auto scene = makeWorld(WorldKind::parallel, GetParam().has_clusters);
  scene->step();
  Casts alone(scene->world(), kCasts), together(scene->world(), kCasts);
  alone.forLoop(0, kCasts);
  btParallelFor(0, kCasts, 16, together);
  EXPECT_EQ(together.fractions, alone.fractions);
}

INSTANTIATE_TEST_SUITE_P(, ParallelWorld,
                         ::testing::Values(Case{1, false}, Case{2, false}, Case{4, false}, Case{4, true}),
                         [](const auto& tested) {
                           return std::to_string(tested.param.threads) +
                                  (tested.param.has_clusters ? "Clusters" : "");
                         });

}  // namespace
}  // namespace octoblisk
