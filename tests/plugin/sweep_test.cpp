// Convex sweeps through Bullet's world calls: exact impacts.
#include "octoblisk/sweep.h"

#include <gtest/gtest.h>

#include "bullet_convex.h"
#include "octoblisk/clustered_octree.h"
#include "plugin/cast_scenes.h"
#include "query/triangle_sweep.h"
#include "shapes/box.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;
using testing::Hits;
using testing::Object;
using testing::Scene;
using testing::scenes;
using testing::Way;

struct SweepHits final : btCollisionWorld::ConvexResultCallback, Hits {
  explicit SweepHits(bool all_hits) : Hits{all_hits} {}
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    return gather(result, m_closestHitFraction);
  }
};

testing::SharedMesh cubeOf(double half) {
  return std::make_shared<const TriangleMesh>(shapes::box(Vec3::Constant(-half), Vec3::Constant(half)));
}

/// The oracle: the core's sweep of the whole mesh, which knows no triangles along a path.
class Sweeps : public ::testing::TestWithParam<Scene> {
 protected:
  static std::optional<TimeOfImpact> expected(const ClusteredOctreeShape& shape, const btConvexShape& convex,
                                              const Pose& from, const Pose& to, double tolerance) {
    detail::ConvexCore core;
    core.update(convex);
    return sweep(shape.tree(), detail::BulletConvex(convex, core), Motion(from, to), tolerance);
  }
};

TEST_P(Sweeps, closest_vs_core) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  std::mt19937_64 random(64);
  const btSphereShape sphere(btScalar(0.12));
  const btCapsuleShape capsule(btScalar(0.1), btScalar(0.3));
  const btConeShape cone(btScalar(0.1), btScalar(0.25));
  const btBoxShape box(toBullet(Vec3(0.2, 0.1, 0.05)));
  int hits = 0;
  constexpr int kSweeps = 400;
  for (int i = 0; i < kSweeps; ++i) {
    const btTransform pose = toBullet(testing::randomPose(random, 3.0));
    const Way way = randomWay(random, scene);
    const Mat3 start = testing::randomRotation(random);
    const Pose from{start, way.from}, to{i % 5 == 0 ? testing::randomRotation(random) : start, way.to};
    const btConvexShape* const convexes[] = {&sphere, &capsule, &cone, &box};
    const btConvexShape& convex = *convexes[i % 4];
    SweepHits closest(false);
    Object(shape, pose).sweep(convex, from, to, closest);
    constexpr double kTolerance = 2e-4;
    const auto impact = expected(shape, convex, from, to, kTolerance);
    // A motion that only comes near has no certain answer.
    const auto sure = expected(shape, convex, from, to, 1e-6);
    ASSERT_TRUE(closest.hasHit() || !sure) << "sweep " << i;
    ASSERT_TRUE(impact || !closest.hasHit()) << "sweep " << i;
    if (!sure) continue;
    ++hits;
    // The core's fraction is where the distance falls to its tolerance.
    EXPECT_GE(double(closest.m_closestHitFraction), impact->fraction - 1e-5) << "sweep " << i;
    EXPECT_LE(double(closest.m_closestHitFraction), sure->fraction + 1e-4) << "sweep " << i;
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
}

TEST_P(Sweeps, all_vs_bruteForce) {
  const Scene& scene = GetParam();
  ClusteredOctreeShape shape = scene.shape();
  std::mt19937_64 random(65);
  const btCapsuleShape capsule(btScalar(0.1), btScalar(0.3));
  detail::ConvexCore core;
  core.update(capsule);
  std::size_t hits = 0;
  for (int i = 0; i < 40; ++i) {
    shape.setMargin(btScalar(i % 2 == 0 ? 0.03 : 0.0));
    const Way way = randomWay(random, scene);
    const Mat3 start = testing::randomRotation(random);
    const Pose from{start, way.from}, to{i % 5 == 0 ? testing::randomRotation(random) : start, way.to};
    SweepHits all(true);
    Object(shape, btTransform::getIdentity()).sweep(capsule, from, to, all);
    std::size_t surely = 0, possibly = 0;
    for (std::uint32_t t = 0; t < shape.tree().mesh().triangleCount(); ++t) {
      const auto hitsWithin = [&](double beyond) {
        return detail::sweep(shape.tree().mesh().triangle(t), detail::BulletConvex(capsule, core),
                             Motion(from, to), double(shape.getMargin()) + beyond, 1e-6, 1.0)
            .has_value();
      };
      surely += hitsWithin(-1e-4);
      possibly += hitsWithin(1e-4);
    }
    ASSERT_GE(all.found.size(), surely) << "sweep " << i;
    ASSERT_LE(all.found.size(), possibly) << "sweep " << i;
    hits += all.found.size();
  }
  EXPECT_GT(hits, 100u);
}

/// Bullet's own sweep stops 0.001 units before a triangle.
TEST_P(Sweeps, closest_vs_bvh) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  BulletMesh source(shape.tree().mesh());
  btBvhTriangleMeshShape bvh(source.view(), true);
  bvh.setMargin(0);
  const Object ours(shape, btTransform::getIdentity()), stock(bvh, btTransform::getIdentity());
  const btBoxShape box(btVector3(btScalar(0.2), btScalar(0.1), btScalar(0.05)));
  std::mt19937_64 random(65);
  int hits = 0, both = 0;
  constexpr int kSweeps = 60;
  for (int i = 0; i < kSweeps; ++i) {
    const Way way = randomWay(random, scene);
    const Pose from{testing::randomRotation(random), way.from}, to{from.rotation, way.to};
    SweepHits closest(false), expected_hits(false);
    ours.sweep(box, from, to, closest);
    stock.sweep(box, from, to, expected_hits);
    hits += closest.hasHit();
    if (!closest.hasHit() || !expected_hits.hasHit()) continue;
    ++both;
    if (closest.m_closestHitFraction == 0) continue;  // it starts in touch
    ASSERT_NEAR(closest.m_closestHitFraction, expected_hits.m_closestHitFraction, 1e-2) << "sweep " << i;
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
  EXPECT_GE(both, hits - 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sweeps, ::testing::ValuesIn(scenes()), testing::nameOf);

TEST(Sweep, callbacksThatCollectWhateverTheyReturn) {
  // Bullet ignores the return value of a sweep's callback, so 0 does not end the sweep.
  struct Careless final : btCollisionWorld::ConvexResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult&, bool) override {
      ++hits;
      return 0;
    }
    std::size_t hits = 0;
  };
  const ClusteredOctreeShape shape = scenes()[0].shape();
  const btSphereShape sphere(btScalar(0.2));
  const Pose from{Mat3::Identity(), Vec3(-4, 0.1, 0.1)}, to{Mat3::Identity(), Vec3(4, 0.2, 0.3)};
  Careless careless;
  SweepHits all(true);
  Object(shape, btTransform::getIdentity()).sweep(sphere, from, to, careless);
  Object(shape, btTransform::getIdentity()).sweep(sphere, from, to, all);
  EXPECT_GT(careless.hits, 10u);
  EXPECT_EQ(careless.hits, all.found.size());
}

/// Bullet's own sweep passes the face in 1,293 of 8,484 such sweeps.
TEST(Sweep, theImpactIsThatOfTheFlatFace) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const double half = 0.1 * scale, radius = 0.003 * scale;
    ClusteredOctreeShape cube = shapeOver(cubeOf(half));
    testing::BulletWorld world;
    world.add(cube, 0, testing::at(0, 0, 0));
    btConeShapeZ cone{btScalar(radius), btScalar(2 * radius)};
    cone.setMargin(btScalar(0.01 * radius));
    const btQuaternion upside_down(btVector3(1, 0, 0), SIMD_PI);
    for (double x = -0.95; x < 0.96; x += 0.06) {
      for (double y = -0.95; y < 0.96; y += 0.07) {
        const btTransform from = testing::at(x * half, y * half, 3 * half) * btTransform(upside_down),
                          to = testing::at(x * half, y * half, -3 * half) * btTransform(upside_down);
        btCollisionWorld::ClosestConvexResultCallback swept(from.getOrigin(), to.getOrigin());
        world->convexSweepTest(&cone, from, to, swept);
        ASSERT_TRUE(swept.hasHit()) << x << ' ' << y;
        const double tip = 3 * half - 6 * half * double(swept.m_closestHitFraction) - radius;
        ASSERT_NEAR(tip - double(cone.getMargin()), half, 1e-3 * radius);
        ASSERT_GT(double(swept.m_hitNormalWorld.z()), 0.999);
        ASSERT_NEAR(double(swept.m_hitPointWorld.z()), half, 1e-3 * radius);
      }
    }
  }
}

/// A sphere beside the face x = 0.5 of a cube.
TEST(Sweep, startsInTouch) {
  ClusteredOctreeShape cube = shapeOver(cubeOf(0.5));
  testing::BulletWorld world;
  world.add(cube, 0, testing::at(0, 0, 0));
  const btSphereShape ball(btScalar(0.25));
  const auto swept = [&](double gap, const btVector3& way, double allowed = 0.0) {
    const btTransform from = testing::at(0.75 + gap, 0.1, 0.2);
    const btTransform to(from.getBasis(), from.getOrigin() + way);
    btCollisionWorld::ClosestConvexResultCallback result(from.getOrigin(), to.getOrigin());
    world->convexSweepTest(&ball, from, to, result, btScalar(allowed));
    return result.m_closestHitFraction;
  };
  const btVector3 in(-1, 0, 0), out(1, 0, 0), along(0, btScalar(0.3), 0), none(0, 0, 0);
  // Deeper than rounding: always.
  for (const btVector3& way : {in, out, along, none}) EXPECT_EQ(swept(-0.01, way), 0);
  // Just touching: only if the way leads deeper.
  EXPECT_EQ(swept(0, in), 0);
  EXPECT_EQ(swept(0, out), 1);
  EXPECT_EQ(swept(0, along), 1);
  EXPECT_EQ(swept(0, none), 0);
  // Apart.
  EXPECT_NEAR(double(swept(0.1, in)), 0.1, 1e-4);
  for (const btVector3& way : {out, along, none}) EXPECT_EQ(swept(0.1, way), 1);
  // Within an allowed penetration, as of a character.
  EXPECT_NEAR(double(swept(0.1, in, 0.04)), 0.14, 1e-4);
  EXPECT_NEAR(double(swept(-0.01, in, 0.04)), 0.03, 1e-4);
  for (const btVector3& way : {out, along, none}) EXPECT_EQ(swept(-0.01, way, 0.04), 1);
}

TEST(Sweep, throughTheWorld) {
  ClusteredOctreeShape shape = scenes()[0].shape();
  testing::BulletWorld world;
  world.add(shape, 0, testing::at(10, 0, 0));
  world.add(shape, 0, testing::at(20, 0, 0));
  const btVector3 from(0, 0, 0), to(40, 0, 0);
  btSphereShape ball(btScalar(0.3));
  btCollisionWorld::ClosestConvexResultCallback swept(from, to);
  world->convexSweepTest(&ball, btTransform(btQuaternion::getIdentity(), from),
                         btTransform(btQuaternion::getIdentity(), to), swept);
  ASSERT_TRUE(swept.hasHit());
  EXPECT_NEAR(swept.m_closestHitFraction * 40, 10 - 2.7 - 0.3, 1e-2);
}

}  // namespace
}  // namespace octoblisk
