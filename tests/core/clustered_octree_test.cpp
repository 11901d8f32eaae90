#include "octoblisk/clustered_octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;
namespace {

using testing::SharedMesh;

std::vector<SharedMesh> meshes() {
  std::mt19937_64 random(11);
  const SharedMesh torus = testing::torus(3, 1, 48, 24);
  const TriangleMesh one({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  std::vector<TriangleMesh::Indices> same(3000, {0, 1, 2});
  return {torus,
          testing::fan(11, 16),
          testing::waveSheet(5, 1, 40),
          testing::soup(random, 3000, 10, 0.5),
          testing::boxMesh({1, 2, 3}),
          std::make_shared<const TriangleMesh>(one),
          std::make_shared<const TriangleMesh>(one.vertices(), same),  // all duplicates
          std::make_shared<const TriangleMesh>(std::vector<Vec3>{{1, 2, 3}},
                                               std::vector<TriangleMesh::Indices>(100)),
          testing::scaledAndMoved(torus, 1e9, {1e11, 0, 0}),
          testing::scaledAndMoved(torus, 1e-9, {1, 1, 1}),
          testing::scaledAndMoved(torus, 1e-30, {0, 0, 0}),
          testing::scaledAndMoved(torus, 1, {1e8, -1e8, 1e8})};
}

TEST(ClusteredOctree, isValidForEveryMeshAndPartition) {
  for (const SharedMesh& mesh : meshes()) {
    for (const int capacity : {1, 3, 8}) {
      ClusteredOctree::build(mesh, {.leaf_capacity = capacity}).validate();
      for (const int clusters : {1, 2, 8}) {
        ClusteredOctree::build(
            mesh, {.partition = PartitionKind::paper, .leaf_capacity = capacity, .clusters = clusters})
            .validate();
      }
    }
    ClusteredOctree::build(mesh, {.partition = PartitionKind::paper, .leaf_capacity = 10}).validate();
  }
}

TEST(ClusteredOctree, leavesHoldNoMoreThanTheirCapacity) {
  const SharedMesh mesh = testing::fan(7, 20);
  for (const PartitionKind partition : {PartitionKind::clustering, PartitionKind::paper}) {
    for (const int capacity : {1, 5, 8}) {
      const ClusteredOctree tree =
          ClusteredOctree::build(mesh, {.partition = partition, .leaf_capacity = capacity});
      std::size_t leaves = 0;
      for (const TreeNode& node : treeOf(tree).nodes()) {
        for (const Child child : node.children) {
          if (!child.isLeaf()) continue;
          ++leaves;
          EXPECT_LE(child.count(), static_cast<std::uint32_t>(capacity));
        }
      }
      EXPECT_EQ(tree.stats().leaves, leaves);
      EXPECT_EQ(tree.stats().triangles, mesh->triangleCount());
      EXPECT_EQ(tree.stats().nodes, treeOf(tree).nodeCount());
    }
  }
}

TEST(ClusteredOctree, partsAreNeverMixedInTheUpperLevels) {
  constexpr int kBlades = 11;
  const SharedMesh mesh = testing::fan(kBlades, 12);
  std::vector<int> blade;
  const std::size_t triangles_of_blade = mesh->triangleCount() / kBlades;
  for (std::size_t t = 0; t < mesh->triangleCount(); ++t)
    blade.push_back(static_cast<int>(t / triangles_of_blade));
  const ClusteredOctree tree = ClusteredOctree::build(
      mesh, {.partition = PartitionKind::paper, .clusters = 3, .part_of_triangle = blade});
  tree.validate();
  for (const TreeNode& node : treeOf(tree).nodes()) {
    for (const Child child : node.children) {
      if (!child.isLeaf()) continue;
      std::set<int> blades;
      for (const std::uint32_t t : treeOf(tree).triangles(child)) blades.insert(blade[t]);
      EXPECT_EQ(blades.size(), 1u);
    }
  }
}

TEST(ClusteredOctree, isTheSameEveryTime) {
  const SharedMesh mesh = testing::fan(5, 20);
  const ClusteredOctree a = ClusteredOctree::build(mesh), b = ClusteredOctree::build(mesh);
  EXPECT_TRUE(std::ranges::equal(treeOf(a).triangleOrder(), treeOf(b).triangleOrder()));
  ASSERT_EQ(treeOf(a).nodes().size(), treeOf(b).nodes().size());
  EXPECT_EQ(std::memcmp(treeOf(a).nodes().data(), treeOf(b).nodes().data(),
                        treeOf(a).nodes().size() * sizeof(TreeNode)),
            0);
}

TEST(ClusteredOctree, boxesGrowTighterWithDepth) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::fan(9, 20));
  double above = tree.stats().root_volume;
  for (int depth = 1; depth <= 3; ++depth) {
    double volume = 0.0;
    for (const Obb& box : tree.boxes(depth)) volume += box.volume();
    EXPECT_LT(volume, above);
    above = volume;
  }
  EXPECT_EQ(tree.boxes(0).size(), 1u);
  EXPECT_EQ(tree.boxes(ClusteredOctree::kMaxDepth).size(), tree.stats().leaves);
}

TEST(ClusteredOctree, refusesBadOptions) {
  const SharedMesh mesh = testing::boxMesh({1, 1, 1});
  EXPECT_THROW(ClusteredOctree::build(nullptr), std::invalid_argument);
  EXPECT_THROW(ClusteredOctree::build(mesh, {.leaf_capacity = 0}), std::invalid_argument);
  EXPECT_THROW(ClusteredOctree::build(mesh, {.leaf_capacity = 9}), std::invalid_argument);
  EXPECT_THROW(ClusteredOctree::build(mesh, {.threads = -1}), std::invalid_argument);
  EXPECT_THROW(ClusteredOctree::build(mesh, {.clusters = 9}), std::invalid_argument);
  EXPECT_THROW(ClusteredOctree::build(mesh, {.part_of_triangle = {1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
