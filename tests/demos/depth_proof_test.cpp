// Proofs that a part stays within a depth on a motion, compared with closed forms and with depths at many
// places.
#include "grinding/depth_proof.h"

#include <gtest/gtest.h>

#include <random>

#include "demos/block.h"
#include "grinding/motion_check.h"
#include "models/shared_tree.h"
#include "octoblisk/depth.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

constexpr double kMaxDepth = 0.1;

/// A tree and its surface.
struct Solid {
  explicit Solid(const TriangleMesh& mesh) : tree(treeOf(mesh)), surface(*tree) {}
  std::shared_ptr<const ClusteredOctree> tree;
  octoblisk::Surface surface;
};

TEST(DepthProof, aSlideWithinTheLimitIsProvedAndOneBeyondIsNot) {
  const Solid wall(block({1, 50, 50}, 3)), tool(block({0.5, 20, 2}, 4));
  const DepthProof proof(wall.surface, tool.surface);
  const auto isProved = [&](double depth_from, double depth_to) {
    const Motion motion(at(1.5 - depth_from, -3, 0), at(1.5 - depth_to, 3, 0));
    return proof.holds(motion, 0.0, 1.0, Vec3::UnitX(), kMaxDepth);
  };
  EXPECT_TRUE(isProved(0.02, 0.02));
  EXPECT_TRUE(isProved(0.02, 0.08));
  EXPECT_TRUE(isProved(-5.0, 0.08));
  EXPECT_FALSE(isProved(0.02, 0.11));
  const Motion motion(at(1.48, -3, 0), at(1.39, 3, 0));  // 0.1 mm deep at eight ninths of the motion
  EXPECT_TRUE(proof.holds(motion, 0.0, 0.8, Vec3::UnitX(), kMaxDepth));
  EXPECT_FALSE(proof.holds(motion, 0.0, 0.95, Vec3::UnitX(), kMaxDepth));
  EXPECT_FALSE(proof.holds(motion, 0.0, 0.8, -Vec3::UnitX(), kMaxDepth)) << "the lift leads in";
}

TEST(DepthProof, aRidgeBetweenThePosesIsNotPassedOver) {
  // The ends are 0.02 mm deep in the wall's face; between them is a ridge, 0.2 mm high and 0.2 mm wide.
  TriangleMesh wall = block({1, 50, 50}, 3);
  std::vector<Vec3> vertices = wall.vertices();
  std::vector<TriangleMesh::Indices> triangles = wall.triangles();
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const TriangleMesh ridge = block({0.2, 0.1, 50}, 1);
  for (const Vec3& corner : ridge.vertices()) vertices.push_back(corner + Vec3(1.0, 0, 0));
  for (const auto& [a, b, c] : ridge.triangles()) triangles.push_back({first + a, first + b, first + c});
  const Solid solid(TriangleMesh(vertices, triangles)), tool(block({0.5, 1, 2}, 2));
  const DepthProof proof(solid.surface, tool.surface);
  const Motion over(at(1.48, -3, 0), at(1.48, 3, 0)), beside(at(1.48, -3, 0), at(1.48, -1.2, 0));
  EXPECT_FALSE(proof.holds(over, 0.0, 1.0, Vec3::UnitX(), kMaxDepth));
  EXPECT_TRUE(proof.holds(beside, 0.0, 1.0, Vec3::UnitX(), kMaxDepth));
}

/// A wall that lacks its far side is closed by a cap. What the belt does elsewhere is proved as on the whole
/// wall; what comes near the cap is not.
TEST(DepthProof, aHoleElsewhereChangesNothing) {
  const TriangleMesh whole = block({1, 50, 50}, 3);
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < whole.triangleCount(); ++t) {
    if (centroidOf(whole.triangle(t)).x() > -0.999) triangles.push_back(whole.triangles()[t]);
  }
  ASSERT_LT(triangles.size(), whole.triangleCount());
  const Solid closed(whole), open(TriangleMesh(whole.vertices(), std::move(triangles))),
      tool(block({0.5, 20, 2}, 4));
  ASSERT_FALSE(open.surface.isClosed());
  const DepthProof on_closed(closed.surface, tool.surface), on_open(open.surface, tool.surface);
  int proved = 0;
  constexpr int kMotions = 40;
  for (int i = 0; i < kMotions; ++i) {
    const double depth = 0.15 * i / kMotions;
    const Motion motion(at(1.5 - 0.02, -3, 0), at(1.5 - depth, 3, 0));
    const bool expected = on_closed.holds(motion, 0.0, 1.0, Vec3::UnitX(), kMaxDepth);
    ASSERT_EQ(on_open.holds(motion, 0.0, 1.0, Vec3::UnitX(), kMaxDepth), expected) << depth;
    proved += expected;
  }
  EXPECT_GT(proved, kMotions / 2);
  EXPECT_LT(proved, kMotions);
  const Motion near_cap(at(-1.55, -3, 0), at(-1.55, 3, 0)), off_cap(at(-1.65, -3, 0), at(-1.65, 3, 0));
  EXPECT_FALSE(on_open.holds(near_cap, 0.0, 1.0, -Vec3::UnitX(), kMaxDepth));
  EXPECT_TRUE(on_open.holds(off_cap, 0.0, 1.0, -Vec3::UnitX(), kMaxDepth));
}

TEST(DepthProof, aToolWhollyInsideIsNotWithinTheLimit) {
  const Solid wall(block({20, 20, 20}, 2)), tool(block({1, 1, 1}, 2));
  const DepthProof proof(wall.surface, tool.surface);
  EXPECT_FALSE(proof.holds(Motion(at(0, 0, 0), at(1, 1, 0)), 0.0, 1.0, Vec3::UnitX(), kMaxDepth));
  EXPECT_FALSE(partsWhenLifted(wall.surface, tool.surface, at(0, 0, 0), Vec3::UnitX(), kMaxDepth));
  EXPECT_TRUE(partsWhenLifted(wall.surface, tool.surface, at(20.95, 0, 0), Vec3::UnitX(), kMaxDepth));
  EXPECT_FALSE(partsWhenLifted(wall.surface, tool.surface, at(20.85, 0, 0), Vec3::UnitX(), kMaxDepth));
}

TEST(DepthProof, whatIsProved_vs_depthsAtManyPlaces) {
  const Solid ring(*testing::torus(10.0, 3.0, 60, 30)), tool(block({2, 2, 2}, 3));
  const DepthProof proof(ring.surface, tool.surface);
  DepthQuery query;
  std::mt19937_64 random(83);
  int proved = 0, beyond = 0;
  constexpr int kMotions = 300;
  for (int i = 0; i < kMotions; ++i) {
    // Onto the ring's outside, a little deeper or less.
    Pose from = testing::randomPose(random, 0.0), to = from;
    const double angle = testing::uniform(random, 0.0, 6.28);
    const Vec3 up(std::cos(angle), std::sin(angle), 0.0);
    const auto seated = [&](Pose& pose) {
      double reach = 0.0;
      for (const Vec3& corner : tool.tree->mesh().vertices())
        reach = std::max(reach, -(pose.rotation * corner).dot(up));
      pose.translation = (13.0 + reach - testing::uniform(random, 0.0, 5.0 * kMaxDepth)) * up;
    };
    to.rotation =
        Mat3(Eigen::AngleAxisd(testing::uniform(random, -0.02, 0.02), Vec3::UnitZ()) * from.rotation);
    seated(from);
    seated(to);
    to.translation += testing::uniform(random, -0.3, 0.3) * Vec3::UnitZ();
    const Motion motion(from, to);
    const bool holds = proof.holds(motion, 0.0, 1.0, up, kMaxDepth);
    double deepest = 0.0;
    for (int k = 0; k <= 20; ++k) {
      const Pose pose = motion.at(k / 20.0);
      deepest = std::max({deepest, query.deepest(ring.surface, tool.surface, pose, 1e-4).depth,
                          query.deepest(tool.surface, ring.surface, pose.inverse(), 1e-4).depth});
    }
    if (holds) {
      ASSERT_LE(deepest, kMaxDepth + 1e-9) << i;
    }
    proved += holds;
    beyond += deepest > kMaxDepth;
  }
  EXPECT_GT(proved, kMotions * 3 / 10);
  EXPECT_GT(beyond, kMotions * 2 / 10);
}

}  // namespace
}  // namespace octoblisk::demos
