// The search for triangles near a convex body returns all near triangles and few others.
#include "octoblisk/triangles_near_convex.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/triangle_convex.h"
#include "shared/hard_meshes.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::randomPoint;
using testing::SharedMesh;
using testing::uniform;

ConvexHull randomHull(std::mt19937_64& random, int points, double size, double radius) {
  std::vector<Vec3> corners;
  for (int i = 0; i < points; ++i) corners.push_back(randomPoint(random, size) + Vec3(0.3, 0.0, 0.0));
  return ConvexHull(std::move(corners), radius);
}

/// Hides the corners, so searches cannot use them.
class Cornerless final : public Convex {
 public:
  explicit Cornerless(const Convex& convex) : convex_(convex) {}
  Vec3 support(const Vec3& direction) const override { return convex_.support(direction); }
  double radius() const override { return convex_.radius(); }

 private:
  const Convex& convex_;
};

std::vector<std::uint32_t> near(const ClusteredOctree& tree, const Convex& convex, const Pose& pose,
                                double reach) {
  std::vector<std::uint32_t> found;
  forEachTriangleNear(tree, convex, pose, reach, [&](std::uint32_t triangle) {
    found.push_back(triangle);
    return false;
  });
  std::ranges::sort(found);
  return found;
}

void expectAllThatAreNear(const ClusteredOctree& tree, double place, double size) {
  std::mt19937_64 random(91);
  std::size_t are_near = 0, handed = 0, hits = 0;
  constexpr std::size_t kCases = 200;
  for (std::size_t i = 0; i < kCases; ++i) {
    const ConvexHull hull = randomHull(random, 1 + int(i % 20), size, i % 3 == 0 ? 0.1 * size : 0.0);
    const Pose pose = testing::randomPose(random, place);
    const double reach = i % 2 == 0 ? 0.0 : uniform(random, 0.0, 0.2 * size);
    const auto found = near(tree, hull, pose, reach);
    ASSERT_EQ(std::ranges::adjacent_find(found), found.end()) << "case " << i;
    const auto without = near(tree, Cornerless(hull), pose, reach);
    std::size_t within = 0;
    for (std::uint32_t t = 0; t < tree.mesh().triangleCount(); ++t) {
      if (!contactOf(pose.inverse() * tree.mesh().triangle(t), hull, reach)) continue;
      ++within;
      ASSERT_TRUE(std::ranges::binary_search(found, t)) << "case " << i << ", triangle " << t;
      ASSERT_TRUE(std::ranges::binary_search(without, t)) << "case " << i << ", triangle " << t;
    }
    hits += within > 0;
    are_near += within;
    handed += found.size();
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 9 / 10);
  EXPECT_LT(handed, 4 * are_near);
}

TEST(TrianglesNearConvex, areNeverMissed_fast) {
  expectAllThatAreNear(ClusteredOctree::build(testing::torus(2, 0.7, 48, 24)), 2.2, 0.5);
}

TEST(TrianglesNearConvex, areNeverMissed_compact) {
  BuildOptions options;
  options.storage = Storage::compact;
  expectAllThatAreNear(ClusteredOctree::build(testing::fan(5, 12), options), 2.0, 0.8);
}

TEST(TrianglesNearConvex, areNeverMissed_inASoup) {
  std::mt19937_64 random(92);
  expectAllThatAreNear(ClusteredOctree::build(testing::soup(random, 2000, 2.0, 0.3)), 2.5, 0.4);
}

TEST(TrianglesNearConvex, onlyThoseNearAPoint_ofHardMeshes) {
  std::mt19937_64 random(93);
  std::size_t within = 0, handed = 0, all = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto kind = static_cast<testing::MeshKind>(i % testing::kMeshKinds);
    const double size = std::pow(10.0, uniform(random, -6.0, 6.0));
    const double far = i % 2 == 0 ? 0.0 : size * std::pow(10.0, uniform(random, 0.0, 4.0));
    const SharedMesh mesh =
        testing::scaledAndMoved(testing::hardMesh(random, kind), size, randomPoint(random, far));
    BuildOptions options;
    if (i % 3 == 0) options.storage = Storage::compact;
    const ClusteredOctree tree = ClusteredOctree::build(mesh, options);
    const double away = size * std::pow(10.0, uniform(random, -4.0, 0.0));
    const Vec3 point = mesh->vertices().front() + randomPoint(random, away);
    const Pose pose = {testing::randomRotation(random), randomPoint(random, far)};
    // Exactly as far as one of the triangles.
    std::vector<double> distances;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t)
      distances.push_back((closestPoint(mesh->triangle(t), point) - point).norm());
    const double farthest = distances[std::size_t(uniform(random, 0.0, double(distances.size())))];
    const double radius = i % 4 == 0 ? 0.0 : uniform(random, 0.0, farthest);
    const auto found = near(tree, ConvexHull({pose.inverse() * point}, radius), pose, farthest - radius);
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      if (!(distances[t] <= farthest - 1e-15 * (size + far))) continue;
      ++within;
      ASSERT_TRUE(std::ranges::binary_search(found, t)) << "case " << i << ", triangle " << t;
    }
    handed += found.size();
    all += mesh->triangleCount();
  }
  EXPECT_LT(handed, within * 11 / 10);
  EXPECT_LT(within, all * 7 / 10);
}

TEST(TrianglesNearConvex, ofAPointThatIsVeryFar) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  for (const double far : {1e3, 1e12, 1e19, 2e19, 1e24, 1e28}) {
    const Pose pose{Mat3::Identity(), {0.0, far, 0.0}};
    EXPECT_EQ(near(tree, ConvexHull({Vec3::Zero()}, far), pose, far).size(), 12u) << far;
    EXPECT_TRUE(near(tree, ConvexHull({Vec3::Zero()}, 0.5 * far), pose, 0.25 * far).empty()) << far;
  }
}

TEST(TrianglesNearConvex, noneOfAPoseThatIsNone) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  Pose pose;
  pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(near(tree, ConvexBox(Obb()), pose, 1.0).empty());
}

}  // namespace
}  // namespace octoblisk
