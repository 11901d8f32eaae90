// Compares the distance of two bodies with a brute-force search over every triangle pair, and with closed
// forms.
#include "octoblisk/distance.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/triangle_pair.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/path_query.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

/// 0 if any triangle pair meets, otherwise the least distance of all pairs.
double bruteForceClearance(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a) {
  return testing::bruteForcePairs(a, b, b_in_a).empty() ? testing::bruteForceDistance(a, b, b_in_a) : 0.0;
}

/// Expects the witnesses to be on their triangles, at the reported distance.
void expectWitness(const Clearance& found, const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                   double size) {
  ASSERT_TRUE(found.found());
  const double slack = 1e-11 * size;
  EXPECT_NEAR((found.point_on_a - found.point_on_b).norm(), found.distance, slack);
  const auto to = [](const Triangle& triangle, const Vec3& point) {
    return closestPoints(triangle, Triangle{point, point, point}).distance;
  };
  if (found.distance > 0.0) {
    EXPECT_LE(to(a.triangle(found.triangle_a), found.point_on_a), slack);
    EXPECT_LE(to(b_in_a * b.triangle(found.triangle_b), found.point_on_b), slack);
  } else {
    EXPECT_TRUE(intersects(a.triangle(found.triangle_a), b_in_a * b.triangle(found.triangle_b)));
  }
}

TEST(Distance, vs_bruteforce) {
  std::mt19937_64 random(71);
  const std::vector<testing::SharedMesh> meshes = {
      testing::torus(2, 0.7, 18, 9), testing::fan(5, 6), testing::waveSheet(2, 0.4, 9),
      testing::soup(random, 200, 2, 0.5), testing::boxMesh({1, 0.5, 0.2})};
  std::vector<ClusteredOctree> trees;
  for (const auto& mesh : meshes) trees.push_back(ClusteredOctree::build(mesh));
  int touching = 0, poses = 0;
  for (std::size_t a = 0; a < meshes.size(); ++a) {
    for (std::size_t b = 0; b < meshes.size(); ++b) {
      for (int i = 0; i < 12; ++i, ++poses) {
        const Pose b_in_a = testing::randomPose(random, 3.2);
        const double expected = bruteForceClearance(*meshes[a], *meshes[b], b_in_a);
        const Clearance found = distance(trees[a], trees[b], b_in_a);
        ASSERT_NEAR(found.distance, expected, 1e-12) << a << ' ' << b << ' ' << i;
        ASSERT_EQ(found.distance == 0.0, expected == 0.0);
        ASSERT_EQ(found.distance == 0.0, collide(trees[a], trees[b], b_in_a).has_value());
        expectWitness(found, *meshes[a], *meshes[b], b_in_a, 10.0);
        touching += expected == 0.0;

        const Clearance hinted =
            distance(trees[a], trees[b], b_in_a, {.hint = {found.triangle_a, found.triangle_b}});
        ASSERT_EQ(hinted.distance, found.distance);
        // A hint far from the nearest pair.
        const Clearance misled = distance(trees[a], trees[b], b_in_a, {.hint = {0, 0}});
        ASSERT_EQ(misled.distance, found.distance);
        if (expected == 0.0) continue;
        const double below = expected * 0.999, above = expected * 1.001, tolerance = 0.1 * expected;
        const Clearance bounded = distance(trees[a], trees[b], b_in_a, {.upper_bound = below});
        ASSERT_FALSE(bounded.found());
        ASSERT_EQ(bounded.distance, below);
        ASSERT_NEAR(distance(trees[a], trees[b], b_in_a, {.upper_bound = above}).distance, expected, 1e-12);
        const double rough = distance(trees[a], trees[b], b_in_a, {.tolerance = tolerance}).distance;
        ASSERT_GE(rough, expected - 1e-12);
        ASSERT_LE(rough, expected + tolerance);
      }
    }
  }
  EXPECT_GT(touching, poses * 3 / 10);
  EXPECT_LT(touching, poses * 7 / 10);
}

TEST(Distance, ofBoxesIsTheClosedForm) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({1, 2, 3}));
  std::mt19937_64 random(72);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const ClusteredOctree scaled = ClusteredOctree::build(testing::boxMesh(scale * Vec3(1, 2, 3)));
    for (int i = 0; i < 200; ++i) {
      const Vec3 shift = testing::randomPoint(random, 12.0 * scale);
      const Vec3 gap = (shift.cwiseAbs() - 2.0 * scale * Vec3(1, 2, 3)).cwiseMax(0.0);
      const double found = distance(scaled, scaled, {Mat3::Identity(), shift}).distance;
      if (gap.norm() > 0.0) {
        EXPECT_NEAR(found, gap.norm(), 1e-12 * scale);
      }
    }
  }
}

TEST(Distance, ofBodiesOfAnySize_vs_bruteforce) {
  std::mt19937_64 random(72);
  for (const double scale : {1e-12, 1e-8, 1e-7, 1e-6, 1e6, 1e9, 1e11}) {
    const auto scaled = [&](const testing::SharedMesh& mesh) {
      std::vector<Vec3> vertices;
      for (const Vec3& vertex : mesh->vertices()) vertices.push_back(scale * vertex);
      return std::make_shared<const TriangleMesh>(vertices, mesh->triangles());
    };
    const auto a = scaled(testing::soup(random, 100, 1, 0.4)), b = scaled(testing::torus(1, 0.3, 16, 8));
    const ClusteredOctree tree_a = ClusteredOctree::build(a), tree_b = ClusteredOctree::build(b);
    for (int i = 0; i < 40; ++i) {
      Pose pose = testing::randomPose(random, 2.0);
      pose.translation = scale * (pose.translation + pose.translation.normalized());
      const double expected = bruteForceClearance(*a, *b, pose);
      ASSERT_NEAR(distance(tree_a, tree_b, pose).distance, expected, 1e-12 * scale) << scale << ' ' << i;
    }
  }
}

/// Tests triangles that are nearest where long edges pass each other at a small angle.
TEST(Distance, ofEdgesAllButParallel_vs_bruteforce) {
  std::mt19937_64 random(73);
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vec3> of_a, of_b;
    const Vec3 along = testing::randomPoint(random, 1.0).normalized();
    const Vec3 across = along.unitOrthogonal();
    const double turn = testing::uniform(random, 0, 2e-3);
    const Vec3 turned = along + turn * testing::randomPoint(random, 1.0);
    for (int t = 0; t < 4; ++t) {
      const Vec3 at = t * Vec3(1e-6, 2e-6, -1e-6), gap = across * testing::uniform(random, 2e-5, 2e-4);
      for (const double end : {-testing::uniform(random, 0, 1), testing::uniform(random, 0, 1)}) {
        of_a.push_back(at + end * along);
        of_b.push_back(at + gap + end * turned);
      }
      of_a.push_back(at - across + testing::randomPoint(random, 0.7));
      of_b.push_back(at + gap + across + testing::randomPoint(random, 0.7));
    }
    const std::vector<TriangleMesh::Indices> triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}};
    const auto a = std::make_shared<const TriangleMesh>(of_a, triangles);
    const auto b = std::make_shared<const TriangleMesh>(of_b, triangles);
    const ClusteredOctree tree_a = ClusteredOctree::build(a, {.threads = 1});
    const ClusteredOctree tree_b = ClusteredOctree::build(b, {.threads = 1});
    const double expected = bruteForceClearance(*a, *b, Pose{});
    ASSERT_NEAR(distance(tree_a, tree_b, Pose{}).distance, expected, 1e-12) << i;
  }
}

TEST(Distance, farFromTheOriginAndFarApart) {
  const auto mesh = testing::torus(2, 0.7, 18, 9);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  for (const double away : {1e3, 1e6, 1e9, 1e15}) {
    const Pose pose{Mat3::Identity(), Vec3(away, 0, 0)};
    EXPECT_NEAR(distance(tree, tree, pose).distance, away - 2.0 * 2.7, 1e-15 * away + 1e-12) << away;
  }
}

TEST(Distance, ofWhatIsBeyondAllMeasureEnds) {
  const ClusteredOctree ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  for (const double far : {1e20, 1e25, 1e28, 1e30, 1e300}) {
    const Pose pose{Mat3::Identity(), Vec3(far, 0, 0)};
    EXPECT_GT(distance(ring, ring, pose).distance, 1e17) << far;
    PathQuery query(ring, ring);
    EXPECT_GT(query.distance(pose).distance, 1e17) << far;
    EXPECT_TRUE(query.collide({Mat3::Identity(), Vec3(0.1, 0, 0)})) << far;
  }
}

TEST(Distance, ofManyPairsEquallyNear) {
  // One mesh lies in the other with the same gap everywhere. More boxes are about equally near than the to-do
  // list can hold.
  const ClusteredOctree inner = ClusteredOctree::build(testing::torus(1.0, 0.5, 96, 64)),
                        outer = ClusteredOctree::build(testing::torus(1.0, 0.502, 96, 64));
  const Clearance found = distance(inner, outer, Pose{});
  DistanceOptions hinted;
  hinted.hint = {found.triangle_a, found.triangle_b};
  EXPECT_GT(found.distance, 0.0);
  EXPECT_LT(found.distance, 0.002);
  EXPECT_EQ(distance(inner, outer, Pose{}, hinted).distance, found.distance);
}

TEST(Distance, ofNestedSurfacesIsTheirGap) {
  const ClusteredOctree outer = ClusteredOctree::build(testing::boxMesh({2, 2, 2}));
  const ClusteredOctree inner = ClusteredOctree::build(testing::boxMesh({1, 1, 0.5}));
  EXPECT_NEAR(distance(outer, inner, Pose{}).distance, 1.0, 1e-15);
}

TEST(Distance, toConvexBodies_vs_bruteforce) {
  std::mt19937_64 random(73);
  const auto mesh = testing::torus(2, 0.7, 18, 9);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), {0.5, 0.3, 0.8}});
  const auto box_mesh = testing::boxMesh({0.5, 0.3, 0.8});
  int touching = 0;
  constexpr int kPoses = 300;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 3.0);
    double expected = bruteForceClearance(*mesh, *box_mesh, pose);
    const Clearance found = distance(tree, box, pose);
    if (found.distance == 0.0 && expected > 0.0) {  // a triangle entirely inside the box
      const Triangle triangle = pose.inverse() * mesh->triangle(found.triangle_a);
      for (const Vec3& corner : triangle) {
        EXPECT_TRUE((corner.cwiseAbs().array() <= Eigen::Array3d(0.5, 0.3, 0.8)).all());
      }
      expected = 0.0;
    }
    touching += expected == 0.0;
    ASSERT_NEAR(found.distance, expected, 1e-9) << i;
    ASSERT_NEAR((found.point_on_a - found.point_on_b).norm(), expected, 1e-9);
    if (expected > 0.0) {
      ASSERT_FALSE(distance(tree, box, pose, {.upper_bound = 0.99 * expected}).found());
    }
  }
  EXPECT_GT(touching, kPoses * 3 / 10);
  EXPECT_LT(touching, kPoses * 7 / 10);
}

TEST(Distance, ofConvexBodiesThatMeetIsNotBelowABoundOfZero) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), {0.5, 0.5, 0.5}});
  const Pose pose{Mat3::Identity(), Vec3(1.2, 0, 0)};
  EXPECT_EQ(distance(tree, box, pose).distance, 0.0);
  for (const double bound : {0.0, -0.1})
    EXPECT_FALSE(distance(tree, box, pose, {.upper_bound = bound}).found());
}

TEST(Distance, toAConvexBodyAtAPoseThatIsNotFiniteIsInfinite) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), {0.5, 0.5, 0.5}});
  const std::vector<std::uint32_t> triangles = {0, 1};
  std::vector<Contact> found;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Pose pose{Mat3::Identity(), Vec3(bad, 0, 0)};
    EXPECT_FALSE(distance(tree, box, pose, {.hint = {0, kNoTriangle}}).found());
    contacts(tree, triangles, box, pose, 0.1, found);
    EXPECT_TRUE(found.empty());
  }
}

}  // namespace
}  // namespace octoblisk
