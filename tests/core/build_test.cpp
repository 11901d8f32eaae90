// The build of the clustered octree on several threads and at both qualities.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "core/same_bits.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;

/// Meshes large enough for many subtrees and for nodes that all threads divide together.
std::vector<SharedMesh> largeMeshes() {
  std::mt19937_64 random(5);
  std::vector<TriangleMesh::Indices> same(10000, {0, 1, 2});
  return {testing::torus(3, 1, 300, 100), testing::fan(12, 30), testing::soup(random, 20000, 10, 0.3),
          std::make_shared<const TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, same)};
}

TEST(Build, isTheSameForAnyNumberOfThreads) {
  for (const SharedMesh& mesh : largeMeshes()) {
    for (const BuildQuality quality : {BuildQuality::high, BuildQuality::low}) {
      const ClusteredOctree alone = ClusteredOctree::build(mesh, {.quality = quality, .threads = 1});
      alone.validate();
      for (const int threads : {2, 3, 8, 0}) {
        EXPECT_TRUE(sameBits(alone, ClusteredOctree::build(mesh, {.quality = quality, .threads = threads})))
            << mesh->triangleCount() << " triangles, " << threads << " threads";
      }
    }
  }
}

TEST(Build, fastTreesAreAnotherTreeWithLooserBoxes) {
  const SharedMesh mesh = testing::fan(12, 30);
  const ClusteredOctree standard = ClusteredOctree::build(mesh);
  const ClusteredOctree fast = ClusteredOctree::build(mesh, {.quality = BuildQuality::low});
  EXPECT_FALSE(sameBits(standard, fast));
  EXPECT_GT(fast.stats().leaf_volume, standard.stats().leaf_volume);
  EXPECT_LT(fast.stats().leaf_volume, 3.0 * standard.stats().leaf_volume);
}

TEST(Build, bothQualitiesGiveTheVerdictsOfAllPairs) {
  std::mt19937_64 random(17);
  const SharedMesh a = testing::fan(5, 10), b = testing::torus(0.4, 0.1, 16, 8);
  const BuildOptions fast{.quality = BuildQuality::low};
  const ClusteredOctree standard_a = ClusteredOctree::build(a), standard_b = ClusteredOctree::build(b);
  const ClusteredOctree fast_a = ClusteredOctree::build(a, fast), fast_b = ClusteredOctree::build(b, fast);
  const Aabb& bounds = a->bounds();
  constexpr int kPoses = 300;
  int hits = 0;
  for (int i = 0; i < kPoses; ++i) {
    Pose pose = testing::randomPose(random, 1.0);
    pose.translation = bounds.center() + pose.translation.cwiseProduct(bounds.halfExtents());
    const bool expected = !testing::bruteForcePairs(*a, *b, pose).empty();
    hits += expected;
    EXPECT_EQ(collide(standard_a, standard_b, pose).has_value(), expected);
    EXPECT_EQ(collide(fast_a, fast_b, pose).has_value(), expected);
  }
  EXPECT_GT(hits, kPoses * 3 / 10);
  EXPECT_LT(hits, kPoses * 7 / 10);
}

}  // namespace
}  // namespace octoblisk
