// The cache between queries changes no answer.
#include "octoblisk/triangle_cache.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "octoblisk/contacts.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::randomPoint;
using testing::uniform;

ConvexHull randomHull(std::mt19937_64& random, int points) {
  std::vector<Vec3> corners;
  for (int i = 0; i < points; ++i) corners.push_back(randomPoint(random, 0.4));
  return ConvexHull(std::move(corners), 0.02);
}

/// A small step from a pose: a translation and a rotation of about this size.
Pose steppedFrom(const Pose& pose, std::mt19937_64& random, double size) {
  const Vec3 turn = randomPoint(random, size);
  Pose next = pose;
  next.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose.rotation;
  next.translation += randomPoint(random, size);
  return next;
}

void expectEqual(const std::vector<Contact>& found, const std::vector<Contact>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t c = 0; c < found.size(); ++c) {
    EXPECT_EQ(found[c].triangle_a, expected[c].triangle_a);
    EXPECT_EQ(found[c].distance, expected[c].distance);
    EXPECT_EQ(found[c].point_on_a, expected[c].point_on_a);
    EXPECT_EQ(found[c].point_on_b, expected[c].point_on_b);
    EXPECT_EQ(found[c].normal, expected[c].normal);
  }
}

/// Returns the contacts found with the cache, after comparing them with those found without it.
std::vector<Contact> checkedContacts(const ClusteredOctree& tree, const Convex& convex, const Pose& pose,
                                     double reach, TriangleCache& near) {
  std::vector<Contact> found, expected;
  contacts(tree, near.find(tree, convex, pose, reach), convex, pose, reach, found);
  contacts(tree, convex, pose, reach, expected);
  expectEqual(found, expected);
  return found;
}

TEST(TriangleCache, changeNoContactOnAWay) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(2, 0.7, 64, 32));
  std::mt19937_64 random(131);
  TriangleCache near;
  std::size_t hits = 0;
  constexpr std::size_t kWays = 40, kSteps = 50;
  for (std::size_t way = 0; way < kWays; ++way) {
    const ConvexHull hull = randomHull(random, 4 + int(way % 20));
    const double step = std::pow(10.0, uniform(random, -5.0, -0.3));
    Pose pose = testing::randomPose(random, 1.8);
    for (std::size_t i = 0; i < kSteps; ++i) {
      pose = steppedFrom(pose, random, step);
      const double reach = i % 7 == 0 ? 0.1 : 0.01;
      hits += !checkedContacts(tree, hull, pose, reach, near).empty();
    }
  }
  EXPECT_GT(hits, kWays * kSteps * 3 / 10);
  EXPECT_LT(hits, kWays * kSteps * 7 / 10);
}

TEST(TriangleCache, keepsFewThatAreFar) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(2, 0.7, 64, 32));
  std::mt19937_64 random(132);
  TriangleCache near;
  std::vector<Contact> found;
  const ConvexHull hull = randomHull(random, 12);
  Pose pose;
  pose.translation = Vec3(2.0, 0.0, 0.7);
  std::size_t handed = 0, contacting = 0;
  for (int i = 0; i < 200; ++i) {
    pose = steppedFrom(pose, random, 1e-3);
    handed += near.find(tree, hull, pose, 0.01).size();
    contacts(tree, hull, pose, 0.01, found);
    contacting += found.size();
  }
  EXPECT_GT(contacting, 200u);
  EXPECT_LT(handed, 2 * contacting);
}

TEST(TriangleCache, followAnotherTree) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(2, 0.7, 24, 12)),
                        other = ClusteredOctree::build(testing::torus(1.5, 0.7, 24, 12));
  std::mt19937_64 random(133);
  const ConvexHull hull = randomHull(random, 12);
  TriangleCache near;
  Pose pose;
  pose.translation = Vec3(2.0, 0.0, 0.7);
  for (const ClusteredOctree* one : {&tree, &tree, &other, &other, &tree}) {
    ASSERT_FALSE(checkedContacts(*one, hull, pose, 0.1, near).empty());
  }
}

TEST(TriangleCache, followARadiusThatGrows) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(2, 0.7, 64, 32));
  std::mt19937_64 random(135);
  const ConvexHull hull = randomHull(random, 12);
  TriangleCache near;
  std::size_t before = 0;
  for (const double radius : {0.0, 0.0, 0.3, 0.5}) {
    const ConvexHull grown({hull.points().begin(), hull.points().end()}, radius);
    const std::size_t count =
        checkedContacts(tree, grown, {Mat3::Identity(), Vec3(2.0, 0.0, 0.7)}, 0.01, near).size();
    EXPECT_GE(count, before);
    before = count;
  }
  EXPECT_GT(before, 10u);
}

TEST(TriangleCache, followACoreThatGrowsWithinItsBounds) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::waveSheet(2.0, 0.0, 40));
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c)
    corners.emplace_back(c & 1 ? 0.5 : -0.5, c & 2 ? 0.5 : -0.5, c & 4 ? 0.5 : -0.5);
  const ConvexHull tetrahedron({corners[0], corners[3], corners[5], corners[6]}), box(corners);
  Pose pose{Mat3::Identity(), {0.01, 0.02, 0.51}};
  TriangleCache near;
  std::vector<std::size_t> hits;
  for (const ConvexHull* body : {&tetrahedron, &tetrahedron, &tetrahedron, &box}) {
    pose.translation.x() += 1e-4;
    hits.push_back(checkedContacts(tree, *body, pose, 0.02, near).size());
  }
  EXPECT_GT(hits[2], 0u);
  EXPECT_GT(hits[3], 3 * hits[2] / 2);
}

TEST(TriangleCache, forgetTrianglesThatHaveMoved) {
  const testing::SharedMesh mesh = testing::torus(2, 0.7, 24, 12);
  ClusteredOctree tree = ClusteredOctree::build(mesh);
  std::vector<Vec3> raised = mesh->vertices();
  for (Vec3& vertex : raised) vertex.z() += 0.2;
  std::mt19937_64 random(134);
  const ConvexHull hull = randomHull(random, 12);
  TriangleCache near;
  Pose pose;
  pose.translation = Vec3(2.0, 0.0, 0.7);
  for (int i = 0; i < 2; ++i) checkedContacts(tree, hull, pose, 0.01, near);
  tree = std::move(tree).refitted(std::make_shared<const TriangleMesh>(raised, mesh->triangles()));
  near.forget();
  EXPECT_FALSE(checkedContacts(tree, hull, pose, 0.01, near).empty());
}

TEST(TriangleCache, noneOfAPoseThatIsNone) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const ConvexBox box((Obb()));
  TriangleCache near;
  EXPECT_FALSE(near.find(tree, box, Pose(), 2.0).empty());
  Pose pose;
  pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(near.find(tree, box, pose, 2.0).empty());
  EXPECT_FALSE(near.find(tree, box, Pose(), 2.0).empty());
}

}  // namespace
}  // namespace octoblisk
