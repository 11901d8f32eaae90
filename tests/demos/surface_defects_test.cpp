#include "models/surface_defects.h"

#include <gtest/gtest.h>

#include "demos/block.h"
#include "octoblisk/surface.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

TEST(SurfaceDefects, openEdgesAreThoseRoundAHole) {
  const TriangleMesh whole = block({1, 1, 1}, 4);
  EXPECT_TRUE(defectsOf(whole).none());
  EXPECT_TRUE(defectsOf(whole).is_closed);
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  const Triangle gone = whole.triangle(5);
  triangles.erase(triangles.begin() + 5);
  const SurfaceDefects found = defectsOf({whole.vertices(), triangles});
  EXPECT_EQ(found.open.count, 3u);
  EXPECT_EQ(found.non_manifold.count, 0u);
  EXPECT_FALSE(found.is_closed);
  for (const Vec3& end : found.open.first) {
    EXPECT_TRUE(end == gone[0] || end == gone[1] || end == gone[2]) << end.transpose();
  }
}

TEST(SurfaceDefects, duplicatesAndTheirEdgesAreNotOpen) {
  const TriangleMesh whole = block({1, 1, 1}, 4);
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  const auto [a, b, c] = triangles[5];
  triangles.push_back({c, b, a});
  const SurfaceDefects one = defectsOf({whole.vertices(), triangles});
  EXPECT_EQ(one.open.count, 0u);
  EXPECT_EQ(one.non_manifold.count, 3u);
  EXPECT_EQ(one.duplicates, 1u);
  EXPECT_EQ(one.first_duplicate, whole.triangleCount());
  EXPECT_FALSE(one.is_closed);
  triangles = whole.triangles();
  triangles.insert(triangles.end(), whole.triangles().begin(), whole.triangles().end());
  const SurfaceDefects all = defectsOf({whole.vertices(), triangles});
  EXPECT_EQ(all.open.count, 0u);
  EXPECT_EQ(all.non_manifold.count, whole.triangleCount() * 3 / 2);
  EXPECT_EQ(all.duplicates, whole.triangleCount());
  EXPECT_TRUE(all.is_closed) << "every edge has four triangles";
}

TEST(SurfaceDefects, isClosedAsTheCoreSays) {
  std::mt19937_64 random(71);
  for (const auto& mesh : {testing::torus(1.0, 0.3, 12, 8), testing::waveSheet(1.0, 0.1, 6),
                           testing::fan(5, 6), testing::soup(random, 40, 1.0, 0.3)}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    EXPECT_EQ(defectsOf(*mesh).is_closed, octoblisk::Surface(tree).isClosed());
  }
}

TEST(SurfaceDefects, areDescribed) {
  const FaultyEdges one{1, {Vec3(0, 0, 1), Vec3(0, 1, 1)}}, three{3, {Vec3(0, 0, 1), Vec3(0, 1, 1)}};
  EXPECT_EQ(describe({.open = one}), "1 of its edges is open, from (0 0 1) to (0 1 1)");
  EXPECT_EQ(
      describe({.open = three, .non_manifold = one, .duplicates = 2, .first_duplicate = 7}),
      "3 of its edges are open, the first from (0 0 1) to (0 1 1); 1 of its edges is non-manifold, from "
      "(0 0 1) to (0 1 1); 2 of its triangles are duplicates, the first number 7");
}

}  // namespace
}  // namespace octoblisk::demos
