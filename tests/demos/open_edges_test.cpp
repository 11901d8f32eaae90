#include "models/open_edges.h"

#include <gtest/gtest.h>

#include "demos/block.h"
#include "octoblisk/surface.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

TEST(OpenEdges, areThoseRoundAHole) {
  const TriangleMesh whole = block({1, 1, 1}, 4);
  EXPECT_EQ(openEdges(whole).count, 0u);
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  const Triangle gone = whole.triangle(5);
  triangles.erase(triangles.begin() + 5);
  const OpenEdges open = openEdges({whole.vertices(), triangles});
  EXPECT_EQ(open.count, 3u);
  for (const Vec3& end : open.first) {
    EXPECT_TRUE(end == gone[0] || end == gone[1] || end == gone[2]) << end.transpose();
  }
}

TEST(OpenEdges, areThereWhereTheSurfaceIsNotClosed) {
  std::mt19937_64 random(71);
  for (const auto& mesh : {testing::torus(1.0, 0.3, 12, 8), testing::waveSheet(1.0, 0.1, 6),
                           testing::fan(5, 6), testing::soup(random, 40, 1.0, 0.3)}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    EXPECT_EQ(openEdges(*mesh).count == 0, octoblisk::Surface(tree).isClosed());
  }
}

TEST(OpenEdges, areDescribed) {
  EXPECT_EQ(describe({1, {Vec3(0, 0, 1), Vec3(0, 1, 1)}}), "1 of its edges is open, from (0 0 1) to (0 1 1)");
  EXPECT_EQ(describe({3, {Vec3(0, 0, 1), Vec3(0, 1, 1)}}),
            "3 of its edges are open, the first from (0 0 1) to (0 1 1)");
}

}  // namespace
}  // namespace octoblisk::demos
