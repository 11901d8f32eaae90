// Rays and convex sweeps through Bullet's world calls: what the shape gives along the way alone finds what
// its generic path finds, and Bullet's own mesh.
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <compare>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "octoblisk/raycast.h"
#include "plugin/bullet_world.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::BulletMesh;
using testing::SharedMesh;
using testing::uniform;

using RayCallback = btTriangleRaycastCallback;

/// Our shape behind a callback that it does not know: every triangle in the bounds of the way.
ATTRIBUTE_ALIGNED16(struct)
Generic final : btConcaveShape {
  BT_DECLARE_ALIGNED_ALLOCATOR();
  explicit Generic(const ClusteredOctreeShape& wrapped) : shape(wrapped) {
    m_shapeType = FAST_CONCAVE_MESH_PROXYTYPE;
  }
  void processAllTriangles(btTriangleCallback * callback, const btVector3& low, const btVector3& high)
      const override {
    struct Forward final : btTriangleCallback {
      btTriangleCallback* to;
      int* visited;
      void processTriangle(btVector3* triangle, int part, int index) override {
        ++*visited;
        to->processTriangle(triangle, part, index);
      }
    } forward;
    forward.to = callback;
    forward.visited = &visited;
    shape.processAllTriangles(&forward, low, high);
  }
  void getAabb(const btTransform& t, btVector3& low, btVector3& high) const override {
    shape.getAabb(t, low, high);
  }
  void setLocalScaling(const btVector3&) override {}
  const btVector3& getLocalScaling() const override { return shape.getLocalScaling(); }
  void calculateLocalInertia(btScalar, btVector3&) const override {}
  const char* getName() const override { return "generic"; }

  const ClusteredOctreeShape& shape;
  mutable int visited = 0;
};

struct Hit {
  btScalar fraction;
  int part, triangle;
  btScalar x, y, z;  // of the normal
  auto operator<=>(const Hit&) const = default;
};

template <typename Result>
Hit hitOf(const Result& result) {
  const btVector3& normal = result.m_hitNormalLocal;
  return {result.m_hitFraction,
          result.m_localShapeInfo->m_shapePart,
          result.m_localShapeInfo->m_triangleIndex,
          normal.x(),
          normal.y(),
          normal.z()};
}

/// All hits, or the closest.
struct RayHits final : btCollisionWorld::RayResultCallback {
  RayHits(bool all_hits, unsigned flags) : all(all_hits) { m_flags = flags; }
  btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool) override {
    m_collisionObject = result.m_collisionObject;
    if (!all) {
      m_closestHitFraction = result.m_hitFraction;
      hits.clear();
    }
    hits.push_back(hitOf(result));
    return m_closestHitFraction;
  }
  std::vector<Hit> sorted() {
    std::ranges::sort(hits);
    return hits;
  }
  bool all;
  std::vector<Hit> hits;
};

struct SweepHits final : btCollisionWorld::ConvexResultCallback {
  explicit SweepHits(bool all_hits) : all(all_hits) {}
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    if (!all) {
      m_closestHitFraction = result.m_hitFraction;
      hits.clear();
    }
    hits.push_back(hitOf(result));
    return m_closestHitFraction;
  }
  std::vector<Hit> sorted() {
    std::ranges::sort(hits);
    return hits;
  }
  bool all;
  std::vector<Hit> hits;
};

struct Scene {
  const char* name;
  SharedMesh mesh;
  Vec3 scaling;
  double miss;  // by how much rays are off a vertex, at most

  ClusteredOctreeShape shape() const {
    ClusteredOctreeShape made(std::make_shared<const ClusteredOctree>(ClusteredOctree::build(mesh)));
    made.setLocalScaling(toBullet(scaling));
    return made;
  }
};

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

std::vector<Scene> scenes() {
  const Vec3 one = Vec3::Ones();
  return {{"torus", testing::torus(2, 0.7, 48, 24), one, 1.0},
          {"wave", testing::waveSheet(4, 0.5, 40), one, 1.5},
          {"blades", testing::fan(11, 24), one, 0.25},
          {"stretched torus", testing::torus(2, 0.7, 48, 24), {1.5, 0.5, 1}, 0.8},
          {"mirrored blades", testing::fan(11, 24), {-1, 1.2, 0.8}, 0.15}};
}

struct Way {
  Vec3 from, to;
};

Way randomWay(std::mt19937_64& random, const Scene& scene) {
  const auto& vertices = scene.mesh->vertices();
  const Vec3 target = vertices[random() % vertices.size()].cwiseProduct(scene.scaling) +
                      testing::randomPoint(random, scene.miss);
  const Vec3 from = testing::randomPoint(random, 5.0);
  Vec3 to = from + uniform(random, 0.4, 1.6) * (target - from);
  if (random() % 4 == 0) to[int(random() % 3)] = from[int(random() % 3)];
  return {from, to};
}

/// A shape as the one object of a world's query, at a pose.
struct Object {
  Object(const btCollisionShape& shape, const btTransform& pose) {
    object.setCollisionShape(const_cast<btCollisionShape*>(&shape));
    object.setWorldTransform(pose);
  }
  void ray(const Way& way, btCollisionWorld::RayResultCallback& callback) const {
    const btTransform& pose = object.getWorldTransform();
    btTransform from(btQuaternion::getIdentity(), pose * toBullet(way.from));
    btTransform to(btQuaternion::getIdentity(), pose * toBullet(way.to));
    btCollisionWorld::rayTestSingle(from, to, const_cast<btCollisionObject*>(&object),
                                    object.getCollisionShape(), pose, callback);
  }
  void sweep(const btConvexShape& convex, const Pose& from, const Pose& to,
             btCollisionWorld::ConvexResultCallback& callback) const {
    const btTransform& pose = object.getWorldTransform();
    btCollisionWorld::objectQuerySingle(&convex, pose * toBullet(from), pose * toBullet(to),
                                        const_cast<btCollisionObject*>(&object), object.getCollisionShape(),
                                        pose, callback, 0);
  }
  btCollisionObject object;
};

class Casts : public ::testing::TestWithParam<Scene> {};

TEST_P(Casts, rays_vs_genericPath) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  const Generic generic(shape);
  std::mt19937_64 random(61);
  int hits = 0;
  std::size_t all_hits = 0;
  constexpr int kRays = 1000;
  for (int i = 0; i < kRays; ++i) {
    const btTransform pose = toBullet(testing::randomPose(random, 3.0));
    const Object ours(shape, pose), oracle(generic, pose);
    const Way way = randomWay(random, scene);
    for (const unsigned flags :
         {0u, unsigned(RayCallback::kF_FilterBackfaces), unsigned(RayCallback::kF_KeepUnflippedNormal),
          unsigned(RayCallback::kF_FilterBackfaces) | unsigned(RayCallback::kF_KeepUnflippedNormal)}) {
      RayHits all(true, flags), expected_all(true, flags), closest(false, flags),
          expected_closest(false, flags);
      ours.ray(way, all);
      oracle.ray(way, expected_all);
      ours.ray(way, closest);
      oracle.ray(way, expected_closest);
      ASSERT_EQ(all.sorted(), expected_all.sorted()) << "ray " << i << ", flags " << flags;
      ASSERT_EQ(closest.hits.size(), expected_closest.hits.size());
      // Of two at the same fraction either may be the closest.
      ASSERT_EQ(closest.m_closestHitFraction, expected_closest.m_closestHitFraction) << "ray " << i;
      if (flags == 0) hits += closest.hasHit();
      all_hits += all.hits.size();
    }
  }
  EXPECT_GT(hits, kRays * 3 / 10);
  EXPECT_LT(hits, kRays * 7 / 10);
  EXPECT_GT(all_hits, std::size_t(3 * hits));
}

TEST_P(Casts, rays_vs_bvhAndRaycast) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  BulletMesh source(shape.tree().mesh());
  const btBvhTriangleMeshShape bvh(&source, true);
  const Object ours(shape, btTransform::getIdentity()), stock(bvh, btTransform::getIdentity());
  std::mt19937_64 random(62);
  int hits = 0, at_rims = 0;
  constexpr int kRays = 3000;
  for (int i = 0; i < kRays; ++i) {
    const Way way = randomWay(random, scene);
    const unsigned flags = i % 2 ? unsigned(RayCallback::kF_FilterBackfaces) : 0u;
    RayHits closest(false, flags), expected(false, flags), all(true, flags), expected_all(true, flags);
    ours.ray(way, closest);
    stock.ray(way, expected);
    ours.ray(way, all);
    stock.ray(way, expected_all);
    ASSERT_EQ(closest.hasHit(), expected.hasHit()) << "ray " << i;
    ASSERT_NEAR(closest.m_closestHitFraction, expected.m_closestHitFraction, 1e-5) << "ray " << i;
    ASSERT_EQ(all.sorted(), expected_all.sorted()) << "ray " << i;
    hits += closest.hasHit();
    const std::optional<RayHit> exact =
        closestHit(shape.tree(), {way.from, way.to - way.from, 1.0, flags != 0});
    // Bullet's rays hit within a rim of one part in ten thousand round a triangle.
    if (exact.has_value() != closest.hasHit() ||
        (exact && std::abs(exact->t - double(closest.m_closestHitFraction)) > 1e-4)) {
      ++at_rims;
    }
  }
  EXPECT_GT(hits, kRays * 3 / 10);
  EXPECT_LT(hits, kRays * 7 / 10);
  EXPECT_LE(at_rims, kRays / 500);
}

TEST_P(Casts, raysVisitFewTriangles) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  struct Counting final : RayCallback {
    using RayCallback::RayCallback;
    void processTriangle(btVector3* triangle, int part, int index) override {
      ++visited;
      RayCallback::processTriangle(triangle, part, index);
    }
    btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
      ++hits;
      return all ? m_hitFraction : fraction;
    }
    int visited = 0, hits = 0;
    bool all = false;
  };
  std::mt19937_64 random(63);
  int closest_visited = 0, all_visited = 0, all_hits = 0, in_bounds = 0;
  constexpr int kRays = 500;
  for (int i = 0; i < kRays; ++i) {
    const Way way = randomWay(random, scene);
    btVector3 low = toBullet(way.from), high = low;
    low.setMin(toBullet(way.to));
    high.setMax(toBullet(way.to));
    Counting closest(toBullet(way.from), toBullet(way.to)), all = closest;
    all.all = true;
    shape.processAllTriangles(&closest, low, high);
    shape.processAllTriangles(&all, low, high);
    closest_visited += closest.visited;
    all_visited += all.visited;
    all_hits += all.hits;
    Generic generic(shape);
    Counting whole = closest;
    generic.processAllTriangles(&whole, low, high);
    in_bounds += generic.visited;
  }
  EXPECT_GT(in_bounds, 20 * closest_visited);
  EXPECT_LE(closest_visited, all_visited);
  EXPECT_LE(all_visited, all_hits + all_hits / 10);  // those of the rim
}

/// Counts the triangles it is cast at: for each, Bullet asks once how far it reaches from its origin.
ATTRIBUTE_ALIGNED16(struct)
CountingHull final : btConvexHullShape {
  BT_DECLARE_ALIGNED_ALLOCATOR();
  explicit CountingHull(const Vec3& half_extents) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      addPoint(toBullet(half_extents.cwiseProduct(side)));
    }
  }
  btScalar getAngularMotionDisc() const override {
    ++casts;
    return btConvexHullShape::getAngularMotionDisc();
  }
  mutable int casts = 0;
};

TEST_P(Casts, sweeps_vs_genericPath) {
  const Scene& scene = GetParam();
  ClusteredOctreeShape shape = scene.shape();
  std::mt19937_64 random(64);
  const btSphereShape sphere(btScalar(0.12));
  const btCapsuleShape capsule(btScalar(0.1), btScalar(0.3));
  const CountingHull box({0.2, 0.1, 0.05});
  int hits = 0, visited = 0, visited_generic = 0;
  std::size_t all_hits = 0;
  constexpr int kSweeps = 120;
  for (int i = 0; i < kSweeps; ++i) {
    shape.setMargin(btScalar(i % 4 == 0 ? 0.03 : 0.0));
    Generic generic(shape);
    generic.setMargin(shape.getMargin());
    const btTransform pose = toBullet(testing::randomPose(random, 3.0));
    const Object ours(shape, pose), oracle(generic, pose);
    const Way way = randomWay(random, scene);
    const Mat3 start = testing::randomRotation(random);
    const bool turns = i % 5 == 0;
    const Pose from{start, way.from}, to{turns ? testing::randomRotation(random) : start, way.to};
    const btConvexShape& convex = i % 3 == 0   ? static_cast<const btConvexShape&>(sphere)
                                  : i % 3 == 1 ? static_cast<const btConvexShape&>(capsule)
                                               : static_cast<const btConvexShape&>(box);
    SweepHits closest(false), expected_closest(false), all(true), expected_all(true);
    box.casts = 0;
    ours.sweep(convex, from, to, closest);
    visited += box.casts;
    ours.sweep(convex, from, to, all);
    oracle.sweep(convex, from, to, expected_closest);
    box.casts = 0;
    oracle.sweep(convex, from, to, expected_all);
    visited_generic += box.casts;
    ASSERT_EQ(closest.m_closestHitFraction, expected_closest.m_closestHitFraction) << "sweep " << i;
    ASSERT_EQ(all.sorted(), expected_all.sorted()) << "sweep " << i;
    hits += closest.hasHit();
    all_hits += all.hits.size();
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
  EXPECT_GT(all_hits, std::size_t(2 * hits));
  EXPECT_GT(visited, 0);
  EXPECT_GT(visited_generic, 5 * visited);
}

TEST_P(Casts, sweeps_vs_bvh) {
  const Scene& scene = GetParam();
  const ClusteredOctreeShape shape = scene.shape();
  BulletMesh source(shape.tree().mesh());
  btBvhTriangleMeshShape bvh(&source, true);
  bvh.setMargin(0);
  const Object ours(shape, btTransform::getIdentity()), stock(bvh, btTransform::getIdentity());
  const btBoxShape box(btVector3(btScalar(0.2), btScalar(0.1), btScalar(0.05)));
  std::mt19937_64 random(65);
  int hits = 0;
  constexpr int kSweeps = 60;
  for (int i = 0; i < kSweeps; ++i) {
    const Way way = randomWay(random, scene);
    const Pose from{testing::randomRotation(random), way.from}, to{from.rotation, way.to};
    SweepHits closest(false), expected(false);
    ours.sweep(box, from, to, closest);
    stock.sweep(box, from, to, expected);
    ASSERT_EQ(closest.hasHit(), expected.hasHit()) << "sweep " << i;
    ASSERT_NEAR(closest.m_closestHitFraction, expected.m_closestHitFraction, 1e-4) << "sweep " << i;
    hits += closest.hasHit();
  }
  EXPECT_GT(hits, kSweeps * 3 / 10);
  EXPECT_LT(hits, kSweeps * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Casts, ::testing::ValuesIn(scenes()), [](const auto& scene) {
  std::string name = scene.param.name;
  std::ranges::replace(name, ' ', '_');
  return name;
});

TEST(Cast, sweepsThatCollectWhateverTheyReturn) {
  // Bullet does not look at what a sweep's callback returns: 0 does not mean that nothing else is wanted.
  struct Careless final : btCollisionWorld::ConvexResultCallback {
    btScalar addSingleResult(btCollisionWorld::LocalConvexResult&, bool) override {
      ++hits;
      return 0;
    }
    int hits = 0;
  };
  const Scene scene = scenes()[0];
  const ClusteredOctreeShape shape = scene.shape();
  const Generic generic(shape);
  const btSphereShape sphere(btScalar(0.2));
  const Pose from{Mat3::Identity(), Vec3(-4, 0.1, 0.1)}, to{Mat3::Identity(), Vec3(4, 0.2, 0.3)};
  Careless ours, expected;
  Object(shape, btTransform::getIdentity()).sweep(sphere, from, to, ours);
  Object(generic, btTransform::getIdentity()).sweep(sphere, from, to, expected);
  EXPECT_GT(expected.hits, 10);
  EXPECT_EQ(ours.hits, expected.hits);
}

TEST(Cast, throughTheWorld) {
  ClusteredOctreeShape shape = scenes()[0].shape();
  testing::BulletWorld world;
  world.add(shape, 0, testing::at(10, 0, 0));
  world.add(shape, 0, testing::at(20, 0, 0));
  const btVector3 from(0, 0, 0), to(40, 0, 0);
  btCollisionWorld::ClosestRayResultCallback closest(from, to);
  world->rayTest(from, to, closest);
  ASSERT_TRUE(closest.hasHit());
  EXPECT_NEAR(closest.m_hitPointWorld.x(), 10 - 2.7, 1e-2);
  EXPECT_NEAR(closest.m_hitNormalWorld.x(), -1, 5e-2);
  btCollisionWorld::AllHitsRayResultCallback all(from, to);
  world->rayTest(from, to, all);
  EXPECT_GE(all.m_hitFractions.size(), 8);
  btSphereShape ball(btScalar(0.3));
  btCollisionWorld::ClosestConvexResultCallback swept(from, to);
  world->convexSweepTest(&ball, btTransform(btQuaternion::getIdentity(), from),
                         btTransform(btQuaternion::getIdentity(), to), swept);
  ASSERT_TRUE(swept.hasHit());
  EXPECT_NEAR(swept.m_closestHitFraction * 40, 10 - 2.7 - 0.3, 1e-2);
}

}  // namespace
}  // namespace octoblisk
