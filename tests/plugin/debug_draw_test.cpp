// Draws the boxes of a tree and the mesh through Bullet's debug drawer.
#include "octoblisk_bullet/debug_draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "plugin/bullet_world.h"
#include "plugin/shape_over.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

struct Lines final : btIDebugDraw {
  struct Line {
    Vec3 from, to, color;
  };
  std::vector<Line> lines;

  void drawLine(const btVector3& from, const btVector3& to, const btVector3& color) override {
    lines.push_back({fromBullet(from), fromBullet(to), fromBullet(color)});
  }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return DBG_DrawWireframe; }
};

ClusteredOctreeShape torusShape() { return ClusteredOctreeShape(treeOver(testing::torus(2, 0.7, 24, 12))); }

/// The index of the box corner at a point, by the signs of its sides; -1: none.
int cornerOf(const Obb& box, const Vec3& point) {
  const Vec3 local = box.axes.transpose() * (point - box.center);
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(local[axis]) - box.half_extents[axis]) > 1e-4) return -1;
    corner |= (local[axis] > 0.0) << axis;
  }
  return corner;
}

TEST(DebugDraw, clustersAreDrawnAsTheTwelveEdgesOfEachBox) {
  const ClusteredOctreeShape shape = torusShape();
  std::mt19937_64 random(91);
  const Pose pose = testing::randomPose(random, 3.0);
  std::size_t last = 0;
  for (const int depth : {0, 1, 2, ClusteredOctree::kMaxDepth}) {
    Lines drawn;
    drawClusters(drawn, toBullet(pose), shape, depth, btVector3(1, btScalar(0.5), 0));
    const std::vector<Obb> boxes = shape.tree().boxes(depth);
    ASSERT_EQ(drawn.lines.size(), 12 * boxes.size());
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      const Obb box = pose * boxes[b];
      std::set<std::pair<int, int>> edges;
      for (std::size_t i = 12 * b; i < 12 * b + 12; ++i) {
        const int from = cornerOf(box, drawn.lines[i].from), to = cornerOf(box, drawn.lines[i].to);
        ASSERT_TRUE(from >= 0 && to >= 0) << "line " << i;
        const int across = from ^ to;
        const bool flat = box.half_extents.minCoeff() < 1e-3;  // then corners coincide
        EXPECT_TRUE(flat || across == 1 || across == 2 || across == 4) << "line " << i;
        edges.insert(std::minmax(from, to));
        EXPECT_EQ(drawn.lines[i].color, Vec3(1, 0.5, 0));
      }
      EXPECT_TRUE(edges.size() == 12 || box.half_extents.minCoeff() < 1e-3);
    }
    EXPECT_GT(boxes.size(), last);
    last = boxes.size();
  }
  EXPECT_EQ(last, shape.tree().stats().leaves);
  EXPECT_EQ(shape.tree().boxes(-1).size(), 1u);
}

TEST(DebugDraw, theWorldDrawsTheMesh) {
  ClusteredOctreeShape shape = torusShape();
  testing::BulletWorld world;
  Lines drawn;
  world->setDebugDrawer(&drawn);
  const btTransform pose = testing::at(1, 2, 3);
  world->debugDrawObject(pose, &shape, btVector3(1, 0, 0));
  const TriangleMesh& mesh = shape.tree().mesh();
  const auto isVertex = [&](const Vec3& point) {
    return std::ranges::any_of(mesh.vertices(),
                               [&](const Vec3& v) { return (v + Vec3(1, 2, 3) - point).norm() < 1e-5; });
  };
  std::size_t edges = 0;
  for (const Lines::Line& line : drawn.lines) edges += isVertex(line.from) && isVertex(line.to);
  EXPECT_EQ(edges, 3 * mesh.triangleCount());
  world->setDebugDrawer(nullptr);
}

}  // namespace
}  // namespace octoblisk
