// Tests which contacts of a body with a triangulated surface are kept.
#include "contact/internal_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/foot_contacts.h"
#include "octoblisk/contacts.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

Obb boxAt(const Vec3& center, const Vec3& half_extents, double turn) {
  return {center, Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix(), half_extents};
}

TEST(InternalEdges, aBoxInAFlatFloorIsPushedUpAlone) {
  const ClusteredOctree floor = ClusteredOctree::build(testing::waveSheet(3, 0.0, 60));
  std::mt19937_64 random(93);
  InternalEdges edges;
  std::vector<Contact> found;
  int askew = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const double depth = uniform(random, 0.001, 0.02);
    const Vec3 place{uniform(random, -2, 2), uniform(random, -2, 2), 0.3 - depth};
    const Obb box = boxAt(place, {0.5, 0.4, 0.3}, uniform(random, 0, 3));
    contacts(floor, ConvexBox(box), Pose(), 0.02, found);
    const auto isAskew = [](const Contact& c) { return std::abs(c.normal.z()) < 0.999; };
    askew += std::ranges::any_of(found, isAskew);
    const double before = testing::deepest(found);
    edges.removeFrom(found, floor.mesh());
    ASSERT_FALSE(found.empty());
    ASSERT_EQ(testing::deepest(found), before);
    ASSERT_NEAR(before, -depth, 1e-9);
    for (const Contact& contact : found) ASSERT_NEAR(contact.normal.z(), -1.0, 1e-6) << "case " << i;
  }
  EXPECT_GT(askew, kCases / 2);  // otherwise there is nothing to remove
}

/// The sides of two tiles that touch are hidden in the floor, but reach its surface at an edge.
TEST(InternalEdges, aBallOnTilesIsPushedUpAlone) {
  constexpr double kRadius = 0.3;
  testing::SharedMesh tiles = testing::boxMesh({0.5, 0.5, 0.5});
  for (int i = 1; i < 9; ++i) {
    const Vec3 place(i % 3, i / 3, 0.0);
    tiles = testing::joined(*tiles,
                            *testing::moved(*testing::boxMesh({0.5, 0.5, 0.5}), {Mat3::Identity(), place}));
  }
  const ClusteredOctree floor = ClusteredOctree::build(tiles);
  std::mt19937_64 random(94);
  InternalEdges edges;
  std::vector<Contact> found;
  int askew = 0, askew_left = 0;
  constexpr int kCases = 400;
  for (int i = 0; i < kCases; ++i) {
    const double depth = uniform(random, 0.001, 0.02);
    const Vec3 place{uniform(random, 0, 2), uniform(random, 0, 2), 0.5 + kRadius - depth};
    contacts(floor, ConvexHull({place}, kRadius), Pose(), 0.02, found);
    const auto isAskew = [](const Contact& c) { return std::abs(c.normal.z()) < 0.999; };
    askew += std::ranges::any_of(found, isAskew);
    const double before = testing::deepest(found);
    edges.removeFrom(found, floor.mesh());
    ASSERT_EQ(testing::deepest(found), before);
    ASSERT_NEAR(before, -depth, 1e-9);
    askew_left += std::ranges::any_of(found, isAskew);
  }
  EXPECT_GT(askew, kCases / 4);        // otherwise there is nothing to remove
  EXPECT_LE(askew_left, kCases / 20);  // where four tiles meet
}

TEST(InternalEdges, aWallStaysWhereItMeetsTheFloor) {
  const ClusteredOctree room = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  InternalEdges edges;
  std::vector<Contact> found;
  // Onto the top and deeper, and beyond the side at the same time.
  contacts(room, ConvexHull({Vec3(1.0, 0.0, 1.0), Vec3(1.5, 0.0, 1.2), Vec3(1.2, 0.3, 1.5)}, 0.05), Pose(),
           0.02, found);
  ASSERT_FALSE(found.empty());
  const double before = testing::deepest(found);
  edges.removeFrom(found, room.mesh());
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(testing::deepest(found), before);
}

TEST(InternalEdges, bothSidesOfARidgeStay) {
  // Two triangles that share an edge at the top, and a sphere that lies on it.
  const auto roof =
      std::make_shared<const TriangleMesh>(std::vector<Vec3>{{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}},
                                           std::vector<TriangleMesh::Indices>{{0, 1, 2}, {1, 0, 3}});
  const ClusteredOctree tree = ClusteredOctree::build(roof);
  InternalEdges edges;
  std::vector<Contact> found;
  contacts(tree, ConvexHull({Vec3(0.2, 0, 0.5)}, 0.5), Pose(), 0.01, found);
  ASSERT_EQ(found.size(), 2u);
  edges.removeFrom(found, tree.mesh());
  EXPECT_EQ(found.size(), 2u);
}

TEST(FootContacts, aBoxStandsOnAllItsCorners) {
  const ClusteredOctree floor = ClusteredOctree::build(testing::waveSheet(10, 0.0, 1));
  std::mt19937_64 random(94);
  for (int i = 0; i < 100; ++i) {
    const double depth = uniform(random, -0.01, 0.02);
    const Vec3 place{uniform(random, -5, 5), uniform(random, -5, 5), 0.3 - depth};
    const Obb box = boxAt(place, {0.5, 0.4, 0.3}, uniform(random, 0, 3));
    std::vector<Vec3> corners;
    for (int c = 0; c < 8; ++c) {
      corners.push_back(box.center + box.axes * box.half_extents.cwiseProduct(
                                                    Vec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1)));
    }
    const ConvexHull hull(corners);
    std::vector<Contact> found;
    contacts(floor, hull, Pose(), 0.02, found);
    addFootContacts(
        floor.mesh(), [&](const Vec3&) { return hull.points(); }, hull.radius(), Pose(), 0.02, found.size(),
        found);
    for (const Vec3& corner : corners) {
      if (corner.z() > 0.02) continue;
      const auto same = std::ranges::find_if(
          found, [&](const Contact& c) { return (c.point_on_b - corner).norm() < 1e-6; });
      ASSERT_NE(same, found.end()) << "case " << i;
      ASSERT_NEAR(same->distance, corner.z(), 1e-9);
      ASSERT_NEAR(same->point_on_a.z(), 0.0, 1e-9);
      ASSERT_NEAR(same->normal.z(), -1.0, 1e-9);
    }
  }
}

TEST(FootContacts, aLyingCapsuleRestsOnBothEnds) {
  const ClusteredOctree floor = ClusteredOctree::build(testing::waveSheet(10, 0.0, 1));  // two triangles
  std::mt19937_64 random(95);
  int ends_found = 0;
  for (int i = 0; i < 100; ++i) {
    const double radius = 0.3, turn = uniform(random, 0, 6.3);
    const Vec3 middle{uniform(random, -4, 4), uniform(random, -4, 4), radius + uniform(random, -0.01, 0.01)};
    const Vec3 half(0.5 * std::cos(turn), 0.5 * std::sin(turn), 0.0);
    const ConvexHull capsule({middle - half, middle + half}, radius);
    std::vector<Contact> found;
    contacts(floor, capsule, Pose(), 0.02, found);
    addFootContacts(
        floor.mesh(), [&](const Vec3&) { return capsule.points(); }, capsule.radius(), Pose(), 0.02,
        found.size(), found);
    for (const Vec3& end : capsule.points()) {
      const auto below = std::ranges::find_if(found, [&](const Contact& contact) {
        return (contact.point_on_b - (end - Vec3(0, 0, radius))).norm() < 1e-6;
      });
      ASSERT_NE(below, found.end()) << "case " << i;
      ASSERT_NEAR(below->distance, end.z() - radius, 1e-9);
      ASSERT_NEAR(below->normal.z(), -1.0, 1e-9);
      ++ends_found;
    }
  }
  EXPECT_EQ(ends_found, 200);
}

}  // namespace
}  // namespace octoblisk
