// Compares the reference answers with brute force, and OctoBlisk with the reference on a scene of the
// benchmarks.
#include "reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk::bench {
namespace {

TEST(Reference, touchingPairsAndDistances_vs_bruteforce) {
  std::mt19937_64 random(91);
  const TriangleMesh a = *testing::bumpySphere(random, 9.0, 2.0, 14), b = *testing::torus(4.0, 1.5, 16, 8);
  const Reference reference(a);
  int hits = 0, near = 0;
  constexpr int kPoses = 120;
  for (int k = 0; k < kPoses; ++k) {
    const Pose pose{testing::randomRotation(random), 12.5 * testing::randomPoint(random, 1.0).normalized()};
    const std::size_t pairs = testing::bruteForcePairs(a, b, pose).size();
    ASSERT_EQ(reference.touchingPairs(b, pose), pairs) << k;
    hits += pairs > 0;
    if (pairs > 0) continue;
    const double distance = testing::bruteForceDistance(a, b, pose);
    const auto found = reference.distance(1.0, b, pose);
    ASSERT_EQ(found.has_value(), distance <= 1.0) << k;
    if (!found) continue;
    ++near;
    EXPECT_EQ(*found, distance);
    EXPECT_TRUE(reference.within(distance, b, pose));
    EXPECT_FALSE(reference.within(std::nextafter(distance, 0.0), b, pose));
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
  EXPECT_GT(near, 10);
}

TEST(Reference, firstHits_vs_bruteforce) {
  std::mt19937_64 random(92);
  const TriangleMesh mesh = *testing::bumpySphere(random, 9.0, 2.0, 14);
  const Reference reference(mesh);
  int hits = 0;
  for (int k = 0; k < 2000; ++k) {
    const Segment segment{testing::randomPoint(random, 16.0), testing::randomPoint(random, 16.0)};
    double first = 1.0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
      first = std::min(first, hitOf(mesh.triangle(t), segment));
    ASSERT_EQ(reference.firstHit(segment), first) << k;
    hits += first < 1.0;
  }
  EXPECT_GT(hits, 600);
  EXPECT_LT(hits, 1400);
}

TEST(Scene, ourAnswersAreTheReferences) {
  const Scene& scene = sceneNamed("10k", {.poses = 220, .quick = true});
  const Reference reference(*scene.blisk);
  const ClusteredOctree blisk = ClusteredOctree::build(scene.blisk),
                        belt = ClusteredOctree::build(scene.belt);
  std::vector<TrianglePair> pairs;
  std::size_t hits = 0, near = 0;
  for (const Pose& pose : scene.path) {
    touchingPairs(blisk, belt, pose, pairs);
    ASSERT_EQ(reference.touchingPairs(*scene.belt, pose), pairs.size());
    EXPECT_EQ(collide(blisk, belt, pose).has_value(), !pairs.empty());
    hits += !pairs.empty();
    if (!pairs.empty()) continue;
    const auto distance_there = reference.distance(0.5, *scene.belt, pose);
    if (!distance_there) continue;
    ++near;
    EXPECT_NEAR(distance(blisk, belt, pose).distance, *distance_there, 1e-12);
  }
  EXPECT_GT(hits, scene.path.size() * 3 / 10);
  EXPECT_LT(hits, scene.path.size() * 7 / 10);
  EXPECT_GT(near, scene.path.size() / 10);

  std::size_t met = 0;
  for (const Segment& segment : scene.segments) {
    const auto hit =
        closestHit(blisk, {.origin = segment.from, .direction = segment.to - segment.from, .t_max = 1.0});
    const double first = hit ? hit->t : 1.0;
    ASSERT_NEAR(first, reference.firstHit(segment), 1e-9);
    met += first < 1.0;
  }
  EXPECT_GT(met, scene.segments.size() / 10);
}

/// Points on all triangles. Every point of the mesh is within `step` of one of them.
std::vector<Vec3> pointsOn(const TriangleMesh& mesh, double step) {
  std::vector<Vec3> points;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto [a, b, c] = mesh.triangle(t);
    const int pieces =
        1 + static_cast<int>(std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()}) / step);
    for (int i = 0; i <= pieces; ++i) {
      for (int j = 0; i + j <= pieces; ++j) points.emplace_back(a + (i * (b - a) + j * (c - a)) / pieces);
    }
  }
  return points;
}

class Primitives : public ::testing::TestWithParam<Primitive> {};

TEST_P(Primitives, truthAtSmallMeshes_vs_sampling) {
  constexpr double kStep = 0.02;
  const auto [core, margin] = roundedCore(GetParam());
  const std::vector<Vec3> points = pointsOn(*core, kStep);
  for (const std::size_t triangles : {500u, 5000u}) {
    const Scene& scene = sceneNamed(std::to_string(triangles) + "-triangles", {.poses = 400});
    const TriangleMesh& mesh = *scene.blisk;
    ASSERT_EQ(mesh.triangleCount(), triangles);
    const PrimitiveTruth& truth = truthOf(scene, GetParam());
    EXPECT_GT(truth.poses.size(), scene.path.size() * 95 / 100);
    EXPECT_GT(truth.hits, truth.poses.size() * 3 / 10);
    EXPECT_LT(truth.hits, truth.poses.size() * 7 / 10);
    const Reference reference(mesh, 0.1);
    for (std::size_t k = 0; k < truth.poses.size(); k += 20) {
      const Pose& pose = truth.poses[k];
      EXPECT_NEAR(testing::windingNumber(mesh, pose.translation), 0.0, 1e-9) << k;
      double least = std::numeric_limits<double>::infinity();
      for (const Vec3& point : points)
        least = std::min(least, reference.distanceTo(pose * point, margin + kStep));
      if (truth.touches[k]) {
        EXPECT_LE(least, margin + kStep) << k;
      } else {
        EXPECT_GT(least, margin) << k;
      }
      if (truth.distances.empty()) continue;
      EXPECT_EQ(truth.distances[k], testing::bruteForceDistance(mesh, pose.translation) - margin);
      EXPECT_EQ(truth.touches[k], truth.distances[k] < 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Primitives,
                         ::testing::Values(Primitive::sphere, Primitive::box, Primitive::capsule,
                                           Primitive::cylinder, Primitive::hull));

TEST(PrimitiveCores, areConvex) {
  for (const Primitive primitive : {Primitive::box, Primitive::cylinder, Primitive::hull}) {
    const TriangleMesh core = *roundedCore(primitive).core;
    for (std::size_t t = 0; t < core.triangleCount(); ++t) {
      const auto [a, b, c] = core.triangle(t);
      const Vec3 outward = (b - a).cross(c - a).normalized();
      for (const Vec3& vertex : core.vertices()) EXPECT_LT(outward.dot(vertex - a), 1e-12);
    }
    EXPECT_NEAR(testing::windingNumber(core, Vec3::Zero()), 1.0, 1e-9);
  }
}

TEST(Scene, theNutLiesOnTheFlanksOfItsBolt) {
  const Scene& scene = sceneNamed("nut-on-bolt");
  ASSERT_EQ(scene.path.size(), 144u);
  const Reference reference(*scene.blisk);
  for (std::size_t k = 0; k < scene.path.size(); k += 20) {
    Pose pose = scene.path[k];
    EXPECT_GT(reference.touchingPairs(*scene.belt, pose), 1000u) << k;
    pose.translation.z() += 0.5e3 * shapes::axialPlay(kNutThread);  // between the flanks
    EXPECT_EQ(reference.touchingPairs(*scene.belt, pose), 0u) << k;
  }
}

TEST(Scene, refusesNamesOfNone) {
  EXPECT_THROW(sceneNamed("many-triangles"), std::invalid_argument);
  EXPECT_THROW(sceneNamed("501-triangles"), std::invalid_argument);
  EXPECT_THROW(sceneNamed("4-triangles"), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::bench
