// Trees stay valid after their vertices move, and their queries match a brute-force search over every
// triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "core/same_bits.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;
namespace {

using testing::deformed;
using testing::SharedMesh;

SharedMesh scaled(const TriangleMesh& mesh, double factor) {
  return deformed(mesh, [factor](const Vec3& v) { return Vec3(factor * v); });
}

struct Deformation {
  const char* name;
  double spread;  ///< of poses, half of which touch
  double noise;
  std::function<Vec3(const Vec3&)> moved;
};

std::vector<Deformation> deformations() {
  const auto bent = [](const Vec3& v) {
    const double angle = 0.3 * v.x(), radius = 1.0 / 0.3 - v.y();
    return Vec3(radius * std::sin(angle), 1.0 / 0.3 - radius * std::cos(angle), v.z());
  };
  const auto twisted = [](const Vec3& v) {
    return Vec3(Eigen::AngleAxisd(0.8 * v.z() + 0.2 * v.x(), Vec3::UnitX()) * v);
  };
  const auto squeezed = [](const Vec3& v) { return Vec3(0.05 * v.x(), 1.5 * v.y(), 3.0 * v.z()); };
  const auto kept = [](const Vec3& v) { return v; };
  return {{"bent", 5.0, 0.0, bent},
          {"twisted", 6.5, 0.0, twisted},
          {"squeezed", 5.0, 0.0, squeezed},
          {"shaken", 5.0, 0.2, kept},
          {"bent and shaken", 5.0, 0.05, bent}};
}

SharedMesh applied(const Deformation& deformation, const TriangleMesh& mesh) {
  std::mt19937_64 random(31);
  return deformed(mesh, [&](const Vec3& v) {
    return Vec3(deformation.moved(v) + testing::randomPoint(random, deformation.noise));
  });
}

TEST(Refit, isValidForEveryDeformationAndScale) {
  std::mt19937_64 random(32);
  for (const SharedMesh& mesh : {testing::torus(3, 1, 160, 60), testing::fan(9, 12),
                                 testing::boxMesh({1, 2, 3}), testing::soup(random, 2000, 5, 0.4)}) {
    for (const PartitionKind partition : {PartitionKind::clustering, PartitionKind::paper}) {
      const ClusteredOctree tree = ClusteredOctree::build(mesh, {.partition = partition});
      for (const Deformation& deformation : deformations()) {
        for (const double scale : {1e-6, 1.0, 1e6}) {
          SCOPED_TRACE(std::string(deformation.name) + ", scale " + std::to_string(scale));
          const ClusteredOctree fitted = tree.refitted(scaled(*applied(deformation, *mesh), scale));
          EXPECT_NO_THROW(fitted.validate());
          EXPECT_EQ(fitted.stats().leaves, tree.stats().leaves);
          EXPECT_EQ(fitted.stats().depth, tree.stats().depth);
          EXPECT_EQ(fitted.stats().bytes, tree.stats().bytes);
        }
      }
    }
  }
}

/// The least distance of all triangle pairs, if it is no more than the bound. Brute force.
double bruteForceDistanceWithin(const TriangleMesh& a, const TriangleMesh& b, const Pose& pose,
                                double bound) {
  double least = std::numeric_limits<double>::infinity();
  for (const Contact& contact : testing::bruteForceContacts(a, b, pose, bound))
    least = std::min(least, std::max(0.0, contact.distance));
  return least;
}

TEST(Refit, collideAndDistance_vs_bruteforce) {
  const SharedMesh mesh = testing::torus(3, 1, 32, 16), other = testing::torus(2.5, 0.8, 24, 12);
  const ClusteredOctree tree = ClusteredOctree::build(mesh), b = ClusteredOctree::build(other);
  for (const Deformation& deformation : deformations()) {
    SCOPED_TRACE(deformation.name);
    const SharedMesh moved = applied(deformation, *mesh);
    const ClusteredOctree a = tree.refitted(moved);
    std::mt19937_64 random(33);
    std::vector<TrianglePair> pairs;
    int hits = 0, clear = 0;
    constexpr int kPoses = 60;
    for (int i = 0; i < kPoses; ++i) {
      const Pose pose = testing::randomPose(random, deformation.spread);
      const auto expected = testing::bruteForcePairs(*moved, *other, pose);
      hits += !expected.empty();
      touchingPairs(a, b, pose, pairs);
      ASSERT_EQ(pairs, expected) << "pose " << i;
      ASSERT_EQ(collide(b, a, pose.inverse()).has_value(), !expected.empty()) << "pose " << i;
      const double found = distance(a, b, pose).distance;
      if (!expected.empty()) {
        ASSERT_LE(found, 0.0) << "pose " << i;
      } else if (found < 0.5) {
        ASSERT_NEAR(found, bruteForceDistanceWithin(*moved, *other, pose, 0.6), 1e-9) << "pose " << i;
        ++clear;
      } else if (i % 4 == 0) {
        ASSERT_GE(bruteForceDistanceWithin(*moved, *other, pose, 0.49), 0.49) << "pose " << i;
      }
    }
    EXPECT_GE(hits, kPoses * 3 / 10);
    EXPECT_LE(hits, kPoses * 7 / 10);
    EXPECT_GT(clear, 3);
  }
}

/// The first crossing by Cramer's rule, or infinity. No random ray passes an edge by less than its rounding.
double firstCrossing(const TriangleMesh& mesh, const Ray& ray) {
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangleCount(); ++i) {
    const Triangle t = mesh.triangle(i);
    Mat3 columns;
    columns << t[1] - t[0], t[2] - t[0], -ray.direction;
    const Vec3 solved = columns.fullPivLu().solve(ray.origin - t[0]);
    if (solved[0] >= 0.0 && solved[1] >= 0.0 && solved[0] + solved[1] <= 1.0 && solved[2] >= 0.0 &&
        solved[2] <= ray.t_max)
      first = std::min(first, solved[2]);
  }
  return first;
}

TEST(Refit, closestHit_vs_bruteforce) {
  const SharedMesh mesh = testing::torus(3, 1, 32, 16);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  for (const Deformation& deformation : deformations()) {
    SCOPED_TRACE(deformation.name);
    const SharedMesh moved = applied(deformation, *mesh);
    const ClusteredOctree fitted = tree.refitted(moved);
    std::mt19937_64 random(34);
    int hits = 0;
    constexpr int kRays = 300;
    for (int i = 0; i < kRays; ++i) {
      const Vec3 half = moved->bounds().halfExtents(), center = moved->bounds().center();
      const Vec3 from = center + 1.1 * testing::randomPoint(random, 1.0).cwiseProduct(half);
      const Vec3 to = center + 1.1 * testing::randomPoint(random, 1.0).cwiseProduct(half);
      const Ray ray{.origin = from, .direction = to - from, .t_max = 0.5};
      const double expected = firstCrossing(*moved, ray);
      const auto hit = closestHit(fitted, ray);
      ASSERT_EQ(hit.has_value(), std::isfinite(expected)) << "ray " << i;
      if (hit) {
        ASSERT_NEAR(hit->t, expected, 1e-9) << "ray " << i;
      }
      hits += hit.has_value();
    }
    EXPECT_GE(hits, kRays * 3 / 10);
    EXPECT_LE(hits, kRays * 7 / 10);
  }
}

TEST(Refit, withoutDeformationQueriesAreTheSame) {
  const SharedMesh mesh = testing::fan(9, 12);
  const ClusteredOctree tree = ClusteredOctree::build(mesh),
                        ring = ClusteredOctree::build(testing::torus(0.5, 0.15, 20, 12));
  const ClusteredOctree fitted = tree.refitted(std::make_shared<const TriangleMesh>(*mesh));
  EXPECT_NEAR(fitted.stats().leaf_volume, tree.stats().leaf_volume, 1e-3 * tree.stats().leaf_volume);
  std::mt19937_64 random(35);
  std::vector<TrianglePair> pairs, same_pairs;
  int hits = 0;
  constexpr int kPoses = 300;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.3);
    touchingPairs(tree, ring, pose, pairs);
    touchingPairs(fitted, ring, pose, same_pairs);
    ASSERT_EQ(pairs, same_pairs);
    hits += !pairs.empty();
    ASSERT_EQ(distance(tree, ring, pose).distance, distance(fitted, ring, pose).distance);
    const Ray ray{.origin = pose.translation, .direction = pose.rotation.col(0)};
    const auto hit = closestHit(tree, ray), same_hit = closestHit(fitted, ray);
    ASSERT_EQ(hit.has_value(), same_hit.has_value());
    if (hit) {
      ASSERT_EQ(hit->t, same_hit->t);
      ASSERT_EQ(hit->triangle, same_hit->triangle);
    }
  }
  EXPECT_GE(hits, kPoses * 3 / 10);
  EXPECT_LE(hits, kPoses * 7 / 10);
}

TEST(Refit, isTheSameForAnyNumberOfThreadsAndInItsOwnMemory) {
  const SharedMesh mesh = testing::torus(3, 1, 300, 100);  // boxes that threads fit together
  const SharedMesh moved = applied(deformations().back(), *mesh);
  ClusteredOctree tree = ClusteredOctree::build(mesh);
  const ClusteredOctree alone = tree.refitted(moved, 1);
  for (const int threads : {2, 4, 0}) EXPECT_TRUE(sameBits(alone, tree.refitted(moved, threads)));

  const TreeNode* const memory = treeOf(tree).nodes().data();
  {
    const ClusteredOctree shared = tree;
    const ClusteredOctree other = ClusteredOctree(tree).refitted(moved, 4);
    EXPECT_NE(treeOf(other).nodes().data(), memory);
    EXPECT_TRUE(sameBits(alone, other));
    EXPECT_NO_THROW(shared.validate());  // still refers to the first mesh
  }
  tree = std::move(tree).refitted(moved, 4);
  EXPECT_EQ(treeOf(tree).nodes().data(), memory);
  EXPECT_TRUE(sameBits(alone, tree));
  EXPECT_NO_THROW(tree.validate());
}

TEST(Refit, refusesOtherMeshes) {
  const SharedMesh mesh = testing::torus(3, 1, 32, 16);
  ClusteredOctree tree = ClusteredOctree::build(mesh);
  const auto message = [&](const SharedMesh& other) -> std::string {
    try {
      tree.refitted(other);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THROW(tree.refitted(nullptr), std::invalid_argument);
  EXPECT_THROW(tree.refitted(mesh, -1), std::invalid_argument);
  EXPECT_NE(
      message(testing::firstTriangles(*mesh, 1000)).find("1000 triangles, but the tree's mesh has 1024"),
      std::string::npos);
  std::vector<Vec3> more = mesh->vertices();
  more.push_back(Vec3::Zero());
  EXPECT_NE(message(std::make_shared<const TriangleMesh>(more, mesh->triangles()))
                .find("513 vertices, but the tree's mesh has 512"),
            std::string::npos);
  std::vector<TriangleMesh::Indices> turned = mesh->triangles();
  std::swap(turned[77][0], turned[77][1]);
  const auto other = std::make_shared<const TriangleMesh>(mesh->vertices(), turned);
  EXPECT_NE(message(other).find("triangle 77 "), std::string::npos);
  EXPECT_THROW(std::move(tree).refitted(other), std::invalid_argument);
  EXPECT_NO_THROW(tree.validate());
}

}  // namespace
}  // namespace octoblisk
