// Compares whole-mesh queries with a brute-force search over every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/triangle_convex.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/distance.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;

struct Case {
  const char* name;
  SharedMesh a, b;
  double spread;  ///< of the translations
  int poses;
};

std::vector<Case> cases() {
  std::mt19937_64 random(18);
  return {{"linked tori", testing::torus(3, 1, 32, 16), testing::torus(3, 0.8, 32, 16), 5.5, 150},
          {"torus in a fan", testing::fan(9, 10), testing::torus(0.5, 0.15, 20, 12), 1.3, 300},
          {"soups", testing::soup(random, 300, 5, 0.4), testing::soup(random, 300, 5, 0.4), 8.0, 150},
          {"sheets", testing::waveSheet(4, 0.5, 24), testing::waveSheet(3, 0.5, 24), 4.5, 150},
          {"boxes", testing::boxMesh({1, 2, 3}), testing::boxMesh({2, 1, 1}), 4.4, 400}};
}

class Queries : public ::testing::TestWithParam<PartitionKind> {};

TEST_P(Queries, collide_vs_bruteforce) {
  for (const Case& scene : cases()) {
    const ClusteredOctree a = ClusteredOctree::build(scene.a, {.partition = GetParam()});
    const ClusteredOctree b = ClusteredOctree::build(scene.b, {.partition = GetParam()});
    std::mt19937_64 random(19);
    int hits = 0;
    for (int i = 0; i < scene.poses; ++i) {
      const Pose pose = testing::randomPose(random, scene.spread);
      const auto expected = testing::bruteForcePairs(*scene.a, *scene.b, pose);
      const auto found = collide(a, b, pose);
      ASSERT_EQ(found.has_value(), !expected.empty()) << scene.name << ", pose " << i;
      hits += !expected.empty();
      ASSERT_TRUE(!found || std::ranges::binary_search(expected, *found)) << scene.name << ", pose " << i;
    }
    EXPECT_GE(hits, scene.poses * 3 / 10) << scene.name;
    EXPECT_LE(hits, scene.poses * 7 / 10) << scene.name;
  }
}

TEST_P(Queries, contacts_vs_bruteforce) {
  std::vector<Contact> found;
  for (const Case& scene : cases()) {
    const ClusteredOctree a = ClusteredOctree::build(scene.a, {.partition = GetParam()});
    const ClusteredOctree b = ClusteredOctree::build(scene.b, {.partition = GetParam()});
    std::mt19937_64 random(20);
    int near_misses = 0, meeting = 0;
    for (int i = 0; i < scene.poses / 3; ++i) {
      const Pose pose = testing::randomPose(random, scene.spread);
      const double threshold = i % 3 ? 0.1 : 0.0;
      const std::vector<Contact> expected = testing::bruteForceContacts(*scene.a, *scene.b, pose, threshold);
      contacts(a, b, pose, threshold, found);
      ASSERT_EQ(found.size(), expected.size()) << scene.name << ", pose " << i;
      for (std::size_t c = 0; c < found.size(); ++c) {
        ASSERT_EQ(found[c].triangle_a, expected[c].triangle_a);
        ASSERT_EQ(found[c].triangle_b, expected[c].triangle_b);
        ASSERT_EQ(found[c].distance, expected[c].distance);
        ASSERT_EQ(found[c].point_on_a, expected[c].point_on_a);
        (found[c].distance > 0.0 ? near_misses : meeting) += 1;
      }
    }
    EXPECT_GT(near_misses, 10) << scene.name;
    EXPECT_GT(meeting, 10) << scene.name;
  }
}

TEST_P(Queries, convex_vs_bruteforce) {
  const SharedMesh mesh = testing::fan(9, 12);
  const ClusteredOctree tree = ClusteredOctree::build(mesh, {.partition = GetParam()});
  std::vector<Vec3> points;
  std::mt19937_64 random(21);
  for (int i = 0; i < 20; ++i) points.push_back(testing::randomPoint(random, 0.3));
  const ConvexBox box({Vec3(0.1, 0, 0), Mat3::Identity(), Vec3(0.5, 0.25, 0.1)});
  const ConvexHull sphere({Vec3(0, 0.1, 0)}, 0.3), hull(points, 0.01);
  int hits = 0, cases = 0;
  std::vector<Contact> found;
  for (const Convex* convex : {static_cast<const Convex*>(&box), static_cast<const Convex*>(&sphere),
                               static_cast<const Convex*>(&hull)}) {
    for (int i = 0; i < 150; ++i, ++cases) {
      const Pose pose = testing::randomPose(random, 1.2), inverse = pose.inverse();
      std::vector<Contact> expected;
      constexpr double kThreshold = 0.05;
      for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
        if (auto contact = contactOf(inverse * mesh->triangle(t), *convex, kThreshold)) {
          contact->triangle_a = t;
          expected.push_back(*contact);
        }
      }
      contacts(tree, *convex, pose, kThreshold, found);
      ASSERT_EQ(found.size(), expected.size()) << "pose " << i;
      bool meet = false;
      for (std::size_t c = 0; c < found.size(); ++c) {
        ASSERT_EQ(found[c].triangle_a, expected[c].triangle_a);
        ASSERT_NEAR(found[c].distance, expected[c].distance, 1e-14);
        ASSERT_TRUE(found[c].point_on_b.isApprox(pose * expected[c].point_on_b, 1e-12));
        meet |= found[c].distance <= 0.0;
      }
      ASSERT_EQ(collide(tree, *convex, pose).has_value(), meet) << "pose " << i;
      hits += meet;
    }
  }
  EXPECT_GE(hits, cases * 3 / 10);
  EXPECT_LE(hits, cases * 7 / 10);
}

INSTANTIATE_TEST_SUITE_P(Partitions, Queries,
                         ::testing::Values(PartitionKind::clustering, PartitionKind::paper),
                         [](const auto& kind) {
                           return kind.param == PartitionKind::paper ? "paper" : "clustering";
                         });

/// Triangles whose corners are collinear except for rounding. In single precision their normals point
/// anywhere.
SharedMesh slivers(std::mt19937_64& random, int count) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const Vec3 from = testing::randomPoint(random, 0.5), to = testing::randomPoint(random, 0.5);
    vertices.insert(vertices.end(), {from, to, from + testing::uniform(random, 0.2, 0.8) * (to - from)});
    triangles.push_back({first, first + 1, first + 2});
  }
  return std::make_shared<const TriangleMesh>(vertices, triangles);
}

TEST(Queries, sliversAreNotMissed) {
  std::mt19937_64 random(23);
  const SharedMesh thin = slivers(random, 12), wide = testing::soup(random, 12, 0.8, 0.4);
  const ClusteredOctree a = ClusteredOctree::build(thin), b = ClusteredOctree::build(wide);
  std::vector<TrianglePair> found;
  int hits = 0;
  constexpr int kPoses = 20000;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 0.8);
    const auto expected = testing::bruteForcePairs(*thin, *wide, pose);
    hits += !expected.empty();
    touchingPairs(a, b, pose, found);
    ASSERT_EQ(found, expected) << "pose " << i;
    touchingPairs(b, a, pose.inverse(), found);
    ASSERT_EQ(found.empty(), testing::bruteForcePairs(*wide, *thin, pose.inverse()).empty()) << "pose " << i;
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

TEST(Queries, touchingIsColliding) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  EXPECT_TRUE(collide(box, box, {Mat3::Identity(), Vec3(2, 0, 0)}));
  EXPECT_FALSE(collide(box, box, {Mat3::Identity(), Vec3(std::nextafter(2.0, 3.0), 0, 0)}));
  EXPECT_TRUE(collide(box, box, {Mat3::Identity(), Vec3(2, 2, 2)}));
  EXPECT_TRUE(collide(box, box, Pose{}));
  EXPECT_FALSE(collide(box, ClusteredOctree::build(testing::boxMesh({0.5, 0.5, 0.5})),
                       Pose{}));  // inside: no surface meets
}

TEST(Queries, farFromTheOriginNothingIsMissed) {
  const Vec3 far(1e7, -2e7, 3e7);
  const SharedMesh near = testing::torus(3, 1, 32, 16);
  std::vector<Vec3> vertices;
  for (const Vec3& v : near->vertices()) vertices.push_back(v + far);
  const auto mesh = std::make_shared<const TriangleMesh>(vertices, near->triangles());
  const SharedMesh other = testing::torus(3, 0.8, 32, 16);
  const ClusteredOctree a = ClusteredOctree::build(mesh), b = ClusteredOctree::build(other);
  std::mt19937_64 random(22);
  int hits = 0;
  for (int i = 0; i < 100; ++i) {
    Pose pose = testing::randomPose(random, 5.5);
    pose.translation += far;
    const bool expected = !testing::bruteForcePairs(*mesh, *other, pose).empty();
    hits += expected;
    ASSERT_EQ(collide(a, b, pose).has_value(), expected);
  }
  EXPECT_GT(hits, 30);
  EXPECT_LT(hits, 70);
}

/// A sliver among other triangles, with a small triangle at it. The sliver lies along no axis, and its width
/// is `thinness` times its length.
struct SliverScene {
  SharedMesh a, b;

  SliverScene(std::mt19937_64& random, double thinness, double scale, const Vec3& away) {
    const auto point = [&](double size) { return testing::randomPoint(random, size); };
    std::vector<Vec3> corners_of_a(3), corners_of_b;
    const Vec3 from = point(1.0), along = point(1.0);
    const double part = testing::uniform(random, 0, 1);
    corners_of_a = {from, from + along, from + part * along + thinness * point(1.0)};
    for (int i = 0; i < 6; ++i) corners_of_a.push_back(point(1.0));
    const double size = std::pow(10.0, testing::uniform(random, -4, 0));
    const Vec3 at = from + testing::uniform(random, 0, 1) * along, one = point(size), other = point(size);
    corners_of_b = {at - (one + other) * testing::uniform(random, -1, 1), at + one, at + other};
    a = meshOf(corners_of_a, scale, away);
    b = meshOf(corners_of_b, scale, away);
  }

 private:
  static SharedMesh meshOf(const std::vector<Vec3>& corners, double scale, const Vec3& away) {
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> triangles;
    for (const Vec3& corner : corners) vertices.push_back(scale * corner + away);
    for (std::uint32_t v = 0; v < vertices.size(); v += 3) triangles.push_back({v, v + 1, v + 2});
    return std::make_shared<const TriangleMesh>(vertices, triangles);
  }
};

TEST(Queries, sliversOfAnySizeAreNotMissed) {
  std::mt19937_64 random(23);
  const Vec3 far(1e6, -7e5, 8e5);
  int hits = 0, scenes = 0;
  for (const auto& [scale, away] : {std::pair(1.0, Vec3(0, 0, 0)), {1e-6, Vec3(0, 0, 0)}, {1e-6, far}}) {
    for (const double thinness : {1e-2, 1e-4, 1e-6, 1e-8, 0.0}) {
      for (int i = 0; i < 300; ++i, ++scenes) {
        const SliverScene scene(random, thinness, scale, away);
        const ClusteredOctree a = ClusteredOctree::build(scene.a, {.threads = 1});
        const ClusteredOctree b = ClusteredOctree::build(scene.b, {.threads = 1});
        ASSERT_NO_THROW(a.validate());
        const auto expected = testing::bruteForcePairs(*scene.a, *scene.b, Pose{});
        hits += !expected.empty();
        std::vector<TrianglePair> found;
        touchingPairs(a, b, Pose{}, found);
        ASSERT_EQ(found, expected) << scale << ' ' << away.x() << ' ' << thinness << ' ' << i;
        ASSERT_EQ(collide(a, b, Pose{}).has_value(), !expected.empty());
        ASSERT_EQ(distance(a, b, Pose{}).distance == 0.0, !expected.empty());
      }
    }
  }
  EXPECT_GT(hits, 0.3 * scenes);
  EXPECT_LT(hits, 0.7 * scenes);
}

/// Single precision has no normals for such triangles. The threshold is the distance of a pair.
TEST(Queries, contactsOfThinTriangles_vs_bruteforce) {
  std::mt19937_64 random(21);
  const auto triangles = [&] {
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> corners;
    for (std::uint32_t i = 0; i < 24; i += 3) {
      const double width = std::pow(10.0, testing::uniform(random, -9.0, 0.0));
      const Vec3 middle = testing::randomPoint(random, 0.3), half = testing::randomPoint(random, 1.0);
      const Vec3 aside = testing::uniform(random, -1.0, 1.0) * half + testing::randomPoint(random, width);
      vertices.insert(vertices.end(), {middle - half, middle + half, middle + aside});
      corners.push_back({i, i + 1, i + 2});
    }
    return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(corners));
  };
  std::vector<Contact> found;
  std::size_t near_misses = 0;
  for (int i = 0; i < 500; ++i) {
    const SharedMesh a = triangles(), b = triangles();
    const ClusteredOctree tree_a = ClusteredOctree::build(a), tree_b = ClusteredOctree::build(b);
    const Pose pose = testing::randomPose(random, 0.2);
    for (const Contact& farthest : testing::bruteForceContacts(*a, *b, pose, 0.3)) {
      if (!(farthest.distance > 0.0)) continue;
      contacts(tree_a, tree_b, pose, farthest.distance, found);
      ASSERT_EQ(found.size(), testing::bruteForceContacts(*a, *b, pose, farthest.distance).size()) << i;
      ++near_misses;
    }
  }
  EXPECT_GT(near_misses, 5000u);
}

TEST(Queries, posesThatAreNotFiniteMeetNothing) {
  const ClusteredOctree torus = ClusteredOctree::build(testing::torus(3, 1, 32, 16));
  Pose turned;
  turned.rotation(0, 1) = std::nan("");
  const auto moved = [](double x) { return Pose{Mat3::Identity(), Vec3(x, 0, 0)}; };
  for (const Pose& pose : {turned, moved(std::nan("")), moved(HUGE_VAL), moved(1e39)}) {
    std::vector<TrianglePair> pairs;
    std::vector<Contact> found;
    EXPECT_FALSE(collide(torus, torus, pose));
    touchingPairs(torus, torus, pose, pairs);
    contacts(torus, torus, pose, 0.1, found);
    EXPECT_TRUE(pairs.empty() && found.empty());
    EXPECT_FALSE(distance(torus, torus, pose).found());
  }
}

}  // namespace
}  // namespace octoblisk
