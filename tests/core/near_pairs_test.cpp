// The search for near triangle pairs: all within the distance that it returns, but not many more.
#include "query/near_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>

#include "contact/surface_contacts.h"
#include "octoblisk/distance.h"
#include "shared/block.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

TEST(NearPairs, allWithinTheReturnedDistance_vs_bruteForce) {
  std::mt19937_64 random(104);
  const std::vector<testing::SharedMesh> meshes = {testing::torus(1.0, 0.35, 48, 24),
                                                   testing::bumpySphere(random, 1.0, 0.2, 30)};
  std::vector<ClusteredOctree> trees;
  for (const testing::SharedMesh& mesh : meshes) trees.push_back(ClusteredOctree::build(mesh));
  int reduced = 0, whole = 0, meeting = 0;
  std::size_t within = 0, beyond = 0;
  std::vector<NearPair> near;
  for (std::size_t i = 0; i < 40; ++i) {
    const ClusteredOctree &a = trees[i % 2], &b = trees[i / 2 % 2];
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = testing::randomRotation(random).col(0) * uniform(random, 1.0, 2.4);
    const double threshold = uniform(random, 0.1, 1.0);
    const double reach = nearPairs(treeOf(a), treeOf(b), pose, threshold, 0.1 * threshold, near);

    const std::vector<Contact> all = testing::bruteForceContacts(a.mesh(), b.mesh(), pose, threshold);
    std::map<TrianglePair, double> distances;
    for (const Contact& contact : all) distances.emplace(contact.triangles(), contact.distance);
    if (all.empty()) continue;
    const double nearest = std::max(0.0, testing::deepest(all));
    ASSERT_LE(reach, threshold);
    ASSERT_GE(reach, std::min(threshold, nearest + 0.1 * threshold)) << "case " << i;

    std::vector<TrianglePair> found;
    for (const NearPair& pair : near) found.push_back(pair.triangles);
    std::ranges::sort(found);
    ASSERT_EQ(std::ranges::adjacent_find(found), found.end()) << "case " << i;
    for (const auto& [pair, distance] : distances) {
      if (distance > reach) continue;
      ASSERT_TRUE(std::ranges::binary_search(found, pair)) << "case " << i << ": " << distance;
      ++within;
    }
    for (const TrianglePair& pair : found) {
      const auto distance = distances.find(pair);
      beyond += distance == distances.end() || distance->second > reach;
    }
    ++(reach < threshold ? reduced : whole);
    meeting += nearest == 0.0;
    ASSERT_LT(near.size(), 32768u) << "case " << i;
  }
  EXPECT_GT(reduced, 5);
  EXPECT_GT(whole, 5);
  EXPECT_GT(meeting, 5);
  EXPECT_LT(beyond, within / 1000);
}

/// The reach stays beyond the nearest pair, although large triangles have inaccurate distances in single
/// precision, and triangles in one plane may seem to meet.
TEST(NearPairs, flatFacesStayWithinReach) {
  constexpr double kThreshold = 0.035, kSurplus = 0.004;
  const auto blockTree = [](const Vec3& half, int steps) {
    return ClusteredOctree::build(std::make_shared<const TriangleMesh>(testing::block(half, steps)));
  };
  const ClusteredOctree fine = blockTree(Vec3::Constant(0.5), 92), floor = blockTree({4, 4, 0.5}, 1);
  std::vector<NearPair> near;
  SurfaceContacts surfaces;
  std::vector<Contact> found;
  int reduced = 0;
  for (const ClusteredOctree* below : {&floor, &fine}) {
    for (const double gap : {0.018, 0.006}) {
      const Pose pose{Mat3::Identity(), {0, 0, 1.0 + gap}};
      const double reach = nearPairs(treeOf(*below), treeOf(fine), pose, kThreshold, kSurplus, near);
      EXPECT_GE(reach, gap + kSurplus);
      reduced += reach < kThreshold;
      surfaces.find(*below, fine, pose, kThreshold, kSurplus, found);
      for (const Vec3& corner : Aabb{{-0.5, -0.5, 0.5}, {0.5, 0.5, 0.5}}.corners()) {
        const auto isAtCorner = [&](const Contact& contact) {
          return (contact.point_on_a - corner).norm() < 1e-9;
        };
        EXPECT_TRUE(std::ranges::any_of(found, isAtCorner)) << corner.transpose();
      }
      EXPECT_NEAR(testing::deepest(found), gap, 1e-12);
    }
  }
  EXPECT_GT(reduced, 1);
}

/// Closest points are asked for with a large threshold, within which nearly all pairs are.
TEST(NearPairs, fewWithinALargeThreshold) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(1.0, 0.35, 80, 40));
  std::mt19937_64 random(107);
  std::vector<NearPair> near;
  for (const double threshold : {10.0, 1e10, std::numeric_limits<double>::infinity()}) {
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = 3.0 * testing::randomRotation(random).col(0);
    const double reach = nearPairs(treeOf(tree), treeOf(tree), pose, threshold, 0.01, near);
    const double nearest = distance(tree, tree, pose).distance;
    EXPECT_GT(nearest, 0.1);
    EXPECT_GE(reach, nearest + 0.01);
    EXPECT_LT(near.size(), 32768u);
    const auto isNearest = [&](const NearPair& pair) {
      return double(pair.least_distance) <= nearest && nearest <= double(pair.most_distance);
    };
    EXPECT_TRUE(std::ranges::any_of(near, isNearest));
  }
}

}  // namespace
}  // namespace octoblisk
