// Compact trees give the same answers as fast trees, in a quarter of the memory.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/same_bits.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/distance.h"
#include "octoblisk/raycast.h"
#include "octoblisk/sweep.h"
#include "octoblisk/triangles_in_box.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;
namespace {

using testing::SharedMesh;

constexpr double kLeanBytes = 24.0;  // per triangle

ClusteredOctree compact(const SharedMesh& mesh, PartitionKind partition = PartitionKind::clustering) {
  return ClusteredOctree::build(mesh, {.partition = partition, .storage = Storage::compact});
}

TEST(CompactNode, rotationsAreOrthonormalToSinglePrecision) {
  std::mt19937_64 random(71);
  double worst = 0.0, farthest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Mat3 axes = testing::randomRotation(random);
    const Mat3 read = decoded(compactRotation(axes.cast<float>())).cast<double>();
    worst = std::max(worst, (read.transpose() * read - Mat3::Identity()).cwiseAbs().maxCoeff());
    farthest = std::max(farthest, (read - axes).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 4 * 0x1p-23);  // what the rounding of triangle_filter.h allows for
  EXPECT_GT(worst, 0.0);
  EXPECT_LT(farthest, 1e-4);
  EXPECT_GT(farthest, 1e-6);
  for (int turned = 0; turned < 24; ++turned) {  // half turns have w = 0
    Eigen::Matrix3f axes = Eigen::Matrix3f::Zero();
    const int order[3] = {turned % 3, (turned + 1 + turned / 12) % 3, (turned + 2 - turned / 12) % 3};
    for (int k = 0; k < 3; ++k) axes(order[k], k) = (turned / 3 >> k & 1) != 0 ? -1.0f : 1.0f;
    if (axes.determinant() < 0.0f) axes.col(2) *= -1.0f;
    EXPECT_TRUE(decoded(compactRotation(axes)).isApprox(axes, 1e-6f)) << axes;
  }
}

TEST(CompactNode, boxesHoldWhatIsPutIntoThem) {
  std::mt19937_64 random(72);
  for (const double size : {1e-30, 1e-3, 1.0, 1e10}) {
    for (int i = 0; i < 300; ++i) {
      CompactNode node;
      std::array<CompactRotation, kLanes> rotations = {};
      std::array<BoxF, kLanes> boxes;
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (lane % 3 == 2) continue;  // stays empty
        node.children[lane] = Child::leaf(0, 1);
        rotations[lane] = compactRotation(testing::randomRotation(random).cast<float>());
        boxes[lane].axes = decoded(rotations[lane]);
        boxes[lane].center = (size * testing::randomPoint(random, 1.0)).cast<float>();
        Vec3 half = size * testing::randomPoint(random, 1.0).cwiseAbs();
        std::sort(half.data(), half.data() + 3, std::greater<>());
        boxes[lane].half_extents = half.cast<float>();
      }
      const auto pad = static_cast<float>(1e-6 * size);
      node.setBoxes(rotations, boxes, pad);
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const BoxF read = node.box(lane);
        if (node.children[lane].isEmpty()) {
          EXPECT_EQ(read.half_extents, Eigen::Vector3f::Constant(Box8::kEmptyHalfExtent));
          continue;
        }
        EXPECT_EQ(read.axes, boxes[lane].axes);
        const Obb bounds = inMesh(read, Vec3::Zero()), inner = inMesh(boxes[lane], Vec3::Zero());
        for (int corner = 0; corner < 8; ++corner) {
          const Vec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
          const Vec3 point = inner.center + inner.axes * side.cwiseProduct(inner.half_extents);
          EXPECT_TRUE(bounds.contains(point)) << "lane " << lane << ", size " << size;
        }
        const Vec3 growth = bounds.half_extents - inner.half_extents;
        EXPECT_LT(growth.maxCoeff(), 2e-4 * size + pad);
      }
    }
  }
}

TEST(CompactTree, isValidForEveryMesh) {
  std::mt19937_64 random(73);
  const SharedMesh torus = testing::torus(3, 1, 48, 24);
  const TriangleMesh one({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const std::vector<SharedMesh> meshes = {
      torus,
      testing::torus(3, 1, 200, 60),
      testing::fan(11, 16),
      testing::waveSheet(5, 1, 40),
      testing::soup(random, 3000, 10, 0.5),
      testing::boxMesh({1, 2, 3}),
      std::make_shared<const TriangleMesh>(one),
      std::make_shared<const TriangleMesh>(one.vertices(),
                                           std::vector<TriangleMesh::Indices>(3000, {0, 1, 2})),
      std::make_shared<const TriangleMesh>(std::vector<Vec3>{{1, 2, 3}},
                                           std::vector<TriangleMesh::Indices>(100)),
      testing::scaledAndMoved(torus, 1e9, {1e11, 0, 0}),
      testing::scaledAndMoved(torus, 1e-9, {1, 1, 1}),
      testing::scaledAndMoved(torus, 1e-30, {0, 0, 0}),
      testing::scaledAndMoved(torus, 1, {1e8, -1e8, 1e8})};
  for (const SharedMesh& mesh : meshes) {
    for (const PartitionKind partition : {PartitionKind::clustering, PartitionKind::paper}) {
      const ClusteredOctree tree = compact(mesh, partition);
      EXPECT_NO_THROW(tree.validate());
      EXPECT_TRUE(treeOf(tree).isCompact());
      const ClusteredOctree fast = ClusteredOctree::build(mesh, {.partition = partition});
      EXPECT_TRUE(std::ranges::equal(treeOf(tree).triangleOrder(), treeOf(fast).triangleOrder()));
      EXPECT_EQ(tree.stats().leaves, fast.stats().leaves);
      EXPECT_GE(tree.boxes(0)[0].volume(), 0.999 * fast.boxes(0)[0].volume());
    }
  }
}

TEST(CompactTree, takesAQuarterOfTheMemory) {
  for (const SharedMesh& mesh : {testing::torus(3, 1, 300, 100), testing::fan(24, 40)}) {
    const ClusteredOctree tree = compact(mesh), fast = ClusteredOctree::build(mesh);
    const auto triangles = static_cast<double>(mesh->triangleCount());
    EXPECT_EQ(tree.stats().bytes, treeOf(tree).compactNodes().size() * sizeof(CompactNode) +
                                      mesh->triangleCount() * sizeof(std::uint32_t));
    EXPECT_LE(static_cast<double>(tree.stats().bytes) / triangles, kLeanBytes);
    EXPECT_LT(3 * tree.stats().bytes, fast.stats().bytes);
    EXPECT_LT(tree.stats().leaf_volume, 1.3 * fast.stats().leaf_volume);
    EXPECT_TRUE(treeOf(tree).nodes().empty());
  }
}

TEST(CompactTree, isTheSameForAnyNumberOfThreads) {
  const SharedMesh mesh = testing::torus(3, 1, 300, 100);
  const ClusteredOctree alone = ClusteredOctree::build(mesh, {.threads = 1, .storage = Storage::compact});
  for (const int threads : {2, 4, 0}) {
    EXPECT_TRUE(
        sameBits(alone, ClusteredOctree::build(mesh, {.threads = threads, .storage = Storage::compact})));
  }
}

TEST(CompactTree, refits) {
  const SharedMesh mesh = testing::torus(3, 1, 160, 60);
  std::mt19937_64 random(74);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    std::vector<Vec3> vertices;
    for (const Vec3& v : mesh->vertices())
      vertices.push_back(scale * (Vec3(0.1 * v.x(), v.y(), 2.0 * v.z()) + testing::randomPoint(random, 0.1)));
    const auto moved = std::make_shared<const TriangleMesh>(vertices, mesh->triangles());
    ClusteredOctree tree = compact(mesh);
    const ClusteredOctree alone = tree.refitted(moved, 1);
    EXPECT_TRUE(treeOf(alone).isCompact());
    EXPECT_NO_THROW(alone.validate());
    EXPECT_TRUE(sameBits(alone, tree.refitted(moved, 4)));
    EXPECT_TRUE(sameBits(alone, std::move(tree).refitted(moved, 4)));
    EXPECT_EQ(alone.stats().bytes, compact(mesh).stats().bytes);
  }
}

struct CompactCase {
  const char* name;
  SharedMesh a, b;
  double spread;
};

/// Runs every query on two fast trees, two compact trees, and one of each.
TEST(CompactTree, queries_vs_fastTrees) {
  std::mt19937_64 random(75);
  const std::vector<CompactCase> cases = {
      {"tori", testing::torus(3, 1, 32, 16), testing::torus(3, 0.8, 32, 16), 5.5},
      {"torus in a fan", testing::fan(9, 10), testing::torus(0.5, 0.15, 20, 12), 1.3},
      {"soups", testing::soup(random, 300, 5, 0.4), testing::soup(random, 300, 5, 0.4), 8.0},
      {"large and far", testing::scaledAndMoved(testing::torus(3, 1, 32, 16), 1e5, {1e7, 1e7, 1e7}),
       testing::torus(3e5, 8e4, 32, 16), 5.5e5}};
  for (const CompactCase& scene : cases) {
    SCOPED_TRACE(scene.name);
    const ClusteredOctree fast_a = ClusteredOctree::build(scene.a), fast_b = ClusteredOctree::build(scene.b);
    const ClusteredOctree compact_a = compact(scene.a), compact_b = compact(scene.b);
    const ConvexBox box({Vec3::Zero(), Mat3::Identity(), Vec3(0.1, 0.05, 0.02) * scene.spread});
    constexpr int kPoses = 150;
    int hits = 0, swept_to_touch = 0;
    std::vector<TrianglePair> expected_pairs, pairs;
    std::vector<Contact> expected_contacts, found;
    for (int i = 0; i < kPoses; ++i) {
      Pose pose = testing::randomPose(random, scene.spread);
      pose.translation += scene.a->bounds().center();
      touchingPairs(fast_a, fast_b, pose, expected_pairs);
      ASSERT_EQ(expected_pairs, testing::bruteForcePairs(*scene.a, *scene.b, pose)) << "pose " << i;
      hits += !expected_pairs.empty();
      const double reach = 0.02 * scene.spread;
      contacts(fast_a, fast_b, pose, reach, expected_contacts);
      const Clearance expected = distance(fast_a, fast_b, pose);
      for (const auto& [a, b] :
           {std::pair(&compact_a, &compact_b), {&compact_a, &fast_b}, {&fast_a, &compact_b}}) {
        touchingPairs(*a, *b, pose, pairs);
        ASSERT_EQ(pairs, expected_pairs) << "pose " << i;
        ASSERT_EQ(collide(*a, *b, pose).has_value(), !expected_pairs.empty()) << "pose " << i;
        contacts(*a, *b, pose, reach, found);
        ASSERT_EQ(found.size(), expected_contacts.size()) << "pose " << i;
        for (std::size_t c = 0; c < found.size(); ++c) {
          ASSERT_EQ(found[c].triangle_a, expected_contacts[c].triangle_a);
          ASSERT_EQ(found[c].triangle_b, expected_contacts[c].triangle_b);
          ASSERT_EQ(found[c].distance, expected_contacts[c].distance);
        }
        ASSERT_NEAR(distance(*a, *b, pose).distance, expected.distance, 1e-12 * scene.spread) << "pose " << i;
      }
      ASSERT_EQ(collide(compact_a, box, pose).has_value(), collide(fast_a, box, pose).has_value());
      ASSERT_NEAR(distance(compact_a, box, pose).distance, distance(fast_a, box, pose).distance,
                  1e-12 * scene.spread);
      if (i % 5 == 0) {
        const Motion motion(pose, Pose{pose.rotation, scene.a->bounds().center()});
        // The steps depend on the boxes, so only the guarantees of the results are checked.
        const double tolerance = 1e-3 * scene.spread;
        const auto swept = sweep(compact_a, compact_b, motion, tolerance);
        const auto same = sweep(fast_a, fast_b, motion, tolerance);
        ASSERT_EQ(swept.has_value(), same.has_value());
        if (swept) {
          ASSERT_NEAR(swept->fraction, same->fraction, 0.02);
          ASSERT_LE(swept->clearance.distance, 1.126 * tolerance);
          ++swept_to_touch;
        }
      }
    }
    EXPECT_GE(hits, kPoses * 3 / 10);
    EXPECT_LE(hits, kPoses * 7 / 10);
    EXPECT_GT(swept_to_touch, 5);
  }
}

TEST(CompactTree, raysAndClosestPoints_vs_fastTrees) {
  std::mt19937_64 random(76);
  const std::vector<std::pair<SharedMesh, double>> cases = {// and the t_max at which half hit
                                                            {testing::torus(3, 1, 32, 16), 0.5},
                                                            {testing::fan(9, 10), 0.7},
                                                            {testing::soup(random, 500, 3, 0.5), 0.7}};
  for (const auto& [mesh, part] : cases) {
    const ClusteredOctree fast = ClusteredOctree::build(mesh), tree = compact(mesh);
    int hits = 0;
    constexpr int kRays = 2000;
    std::vector<RayHit> expected, found;
    for (int i = 0; i < kRays; ++i) {
      const Vec3 half = 1.1 * mesh->bounds().halfExtents(), center = mesh->bounds().center();
      const Vec3 from = center + testing::randomPoint(random, 1.0).cwiseProduct(half);
      const Vec3 to = center + testing::randomPoint(random, 1.0).cwiseProduct(half);
      const Ray ray{.origin = from, .direction = to - from, .t_max = part};
      allHits(fast, ray, expected);
      allHits(tree, ray, found);
      ASSERT_EQ(found.size(), expected.size()) << "ray " << i;
      for (std::size_t h = 0; h < found.size(); ++h) {
        ASSERT_EQ(found[h].t, expected[h].t);
        ASSERT_EQ(found[h].triangle, expected[h].triangle);
      }
      const auto first = closestHit(tree, ray);
      ASSERT_EQ(first.has_value(), !expected.empty());
      ASSERT_EQ(anyHit(tree, ray), !expected.empty());
      hits += first.has_value();
      const auto closest = closestPoint(tree, from), same = closestPoint(fast, from);
      ASSERT_TRUE(closest && same);
      ASSERT_EQ(closest->distance, same->distance);
      ASSERT_EQ(closest->triangle, same->triangle);
    }
    EXPECT_GE(hits, kRays * 3 / 10);
    EXPECT_LE(hits, kRays * 7 / 10);
  }
}

TEST(CompactTree, solids_vs_fastTrees) {
  std::mt19937_64 random(77);
  const SharedMesh ring = testing::torus(1.0, 0.4, 24, 12), block = testing::boxMesh({0.4, 0.6, 0.2});
  const ClusteredOctree fast_a = ClusteredOctree::build(ring), fast_b = ClusteredOctree::build(block);
  const ClusteredOctree compact_a = compact(ring), compact_b = compact(block);
  const Surface a(fast_a), b(fast_b), lean_a(compact_a), lean_b(compact_b);
  DepthQuery query, lean_query;
  int gouges = 0;
  constexpr int kPoses = 200;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 1.8);
    ASSERT_EQ(containment(lean_a, lean_b, pose), containment(a, b, pose)) << "pose " << i;
    const auto expected = query.deepest(a, b, pose, 1e-4),
               found = lean_query.deepest(lean_a, lean_b, pose, 1e-4);
    ASSERT_EQ(found.gouging, expected.gouging) << "pose " << i;
    ASSERT_NEAR(found.depth, expected.depth, 1e-4) << "pose " << i;
    gouges += found.gouging == Gouging::found;
  }
  EXPECT_GE(gouges, kPoses * 3 / 10);
  EXPECT_LE(gouges, kPoses * 7 / 10);
}

TEST(CompactTree, trianglesInBox_vs_fastTrees) {
  const SharedMesh mesh = testing::fan(9, 10);
  const ClusteredOctree tree = compact(mesh);
  std::mt19937_64 random(78);
  int met = 0, cases = 0;
  for (int i = 0; i < 200; ++i) {
    const Pose pose = testing::randomPose(random, 1.0);
    const Obb box{pose.translation, pose.rotation, Vec3(0.4, 0.3, 0.2)};
    std::vector<bool> visited(mesh->triangleCount(), false);
    forEachTriangleIn(tree, box, 0.0, [&](std::uint32_t t) {
      visited[t] = true;
      return false;
    });
    bool any = false;
    for (std::size_t t = 0; t < mesh->triangleCount(); ++t) {
      if (testing::boxTriangleOverlap(box, mesh->triangle(t)) < 0.0) continue;
      EXPECT_TRUE(visited[t]) << "box " << i << ", triangle " << t;
      any = true;
    }
    met += any;
    ++cases;
  }
  EXPECT_GE(met, cases * 3 / 10);
  EXPECT_LE(met, cases * 7 / 10);
}

}  // namespace
}  // namespace octoblisk
