// Tests the contacts that closed meshes and flat faces add to those of triangles.
#include "contact/solid_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/far_vertices.h"
#include "contact/flat_contacts.h"
#include "contact/point_in_solid.h"
#include "octoblisk/contacts.h"
#include "octoblisk/containment.h"
#include "query/thickness.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

/// Near each side of the bounds, where the way out is in another direction.
TEST(PointInSolid, nearEachSide_vs_locate) {
  std::mt19937_64 random(82);
  const ClusteredOctree tree = ClusteredOctree::build(testing::bumpySphere(random, 1.0, 0.4, 24));
  const SolidMesh solid(tree, SolidMesh::Kind::simple);
  const Surface surface(tree);
  const Aabb& bounds = tree.mesh().bounds();
  for (int side = 0; side < 6; ++side) {
    int inside = 0;
    constexpr int kPoints = 500;
    for (int i = 0; i < kPoints; ++i) {
      Vec3 point = bounds.center() + 0.3 * testing::randomPoint(random, 1.0);
      const double depth = testing::uniform(random, 0.0, 0.5);
      point[side / 2] = side % 2 == 0 ? bounds.min[side / 2] + depth : bounds.max[side / 2] - depth;
      const bool is_inside = locate(surface, point) == PointLocation::inside;
      ASSERT_EQ(solid.contains(point), is_inside) << "side " << side << ", point " << i;
      inside += is_inside;
    }
    EXPECT_GE(inside, kPoints * 2 / 10) << "side " << side;
    EXPECT_LE(inside, kPoints * 9 / 10) << "side " << side;
  }
}

/// Follows a point that wanders through a torus in steps of all lengths.
TEST(PointInSolid, followsAWanderingPoint_vs_locate) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(1.0, 0.4, 32, 16));
  const SolidMesh solid(tree, SolidMesh::Kind::simple);
  const Surface surface(tree);
  std::mt19937_64 random(81);
  PointInSolid place;
  Vec3 point = Vec3::Zero();
  int inside = 0;
  constexpr int kSteps = 5000;
  for (int i = 0; i < kSteps; ++i) {
    const double length = std::pow(10.0, testing::uniform(random, -3, -0.5));
    point += length * testing::randomRotation(random).col(0);
    if (point.norm() > 1.6 || std::abs(point.z()) > 0.5) point = Vec3(1.0, 0.0, 0.0);
    const bool is_inside = locate(surface, point) == PointLocation::inside;
    ASSERT_EQ(place.contains(solid, point), is_inside) << i;
    inside += is_inside;
  }
  EXPECT_GE(inside, kSteps * 3 / 10);
  EXPECT_LE(inside, kSteps * 8 / 10);
}

/// The penetration depth of two boxes, by separating axes; below 0 if they are apart.
double boxDepth(const Vec3& half_a, const Vec3& half_b, const Pose& b_in_a) {
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i) {
    axes.insert(axes.end(), {Vec3::Unit(i), b_in_a.rotation.col(i)});
    for (int j = 0; j < 3; ++j) {
      const Vec3 axis = Vec3::Unit(i).cross(b_in_a.rotation.col(j));
      if (axis.norm() > 1e-6) axes.push_back(axis.normalized());
    }
  }
  double depth = std::numeric_limits<double>::infinity();
  for (const Vec3& axis : axes) {
    const double reach =
        half_a.dot(axis.cwiseAbs()) + half_b.dot((b_in_a.rotation.transpose() * axis).cwiseAbs());
    depth = std::min(depth, reach - std::abs(axis.dot(b_in_a.translation)));
  }
  return depth;
}

/// Boxes that dip into a block, often beyond its edges, with a corner inside.
TEST(SolidContacts, theWayOutOfAnEnd_isNoDeeperThanTheBoxes) {
  std::mt19937_64 random(83);
  int poses = 0, with_way_out = 0;
  for (const double radius : {0.0, 0.04}) {
    for (int i = 0; i < 4000; ++i) {
      const auto halfExtents = [&](double least) -> Vec3 {
        return {testing::uniform(random, least, 1.0), testing::uniform(random, least, 1.0),
                testing::uniform(random, least, 0.5)};
      };
      const Vec3 half_a = halfExtents(0.1), half_b = halfExtents(0.05);
      const ClusteredOctree tree = ClusteredOctree::build(testing::boxMesh(half_a));
      const SolidMesh solid(tree, SolidMesh::Kind::simple);
      const ConvexHull box(testing::boxMesh(half_b)->vertices(), radius);
      const Vec3 way = testing::randomRotation(random).col(0);
      Pose pose{testing::randomRotation(random), half_a.norm() * way};
      const double depth = testing::uniform(random, 0.0, 0.05);
      // A step inward by the gap is never too far.
      for (int k = 0; k < 60; ++k) pose.translation += (boxDepth(half_a, half_b, pose) - depth) * way;
      if (solid.contains(pose.translation)) continue;
      const double exact = boxDepth(half_a, half_b, pose) + radius;
      std::vector<Contact> found;
      contacts(tree, box, pose, 0.0, found);
      const auto greatestDepth = [&] {
        return found.empty() ? 0.0 : -std::ranges::min(found, {}, &Contact::distance).distance;
      };
      const double before = greatestDepth();
      const std::size_t of_triangles = found.size();
      PointInSolid middle;
      toSolidContacts(solid, box, pose, 0.0, middle, found);
      ++poses;
      with_way_out += found.size() > of_triangles;
      ASSERT_LE(greatestDepth(), std::max(before, exact) + 1e-9) << "radius " << radius << ", pose " << i;
    }
  }
  EXPECT_GT(poses, 6000);
  EXPECT_GT(with_way_out, poses / 5);
}

/// A box wanders through a torus in steps of all lengths. Its middle is followed, or located at each pose.
TEST(SolidContacts, followTheMiddle_vs_new) {
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(1.0, 0.4, 32, 16));
  const SolidMesh solid(tree, SolidMesh::Kind::simple);
  const ConvexHull box(testing::boxMesh({0.2, 0.15, 0.1})->vertices(), 0.02);
  std::mt19937_64 random(85);
  PointInSolid followed;
  Pose pose;
  constexpr double kReach = 0.05;
  int inside = 0, poses = 0, crossings = 0;
  bool was_inside = false;
  for (int i = 0; i < 5000; ++i) {
    const double length = std::pow(10.0, testing::uniform(random, -3, -0.5));
    pose.translation += length * testing::randomRotation(random).col(0);
    pose.rotation = testing::randomRotation(random);
    if (pose.translation.norm() > 1.8) pose.translation = Vec3(1.0, 0.0, 0.0);
    std::vector<Contact> found;
    contacts(tree, box, pose, kReach, found);
    std::vector<Contact> expected = found;
    toSolidContacts(solid, box, pose, kReach, followed, found);
    PointInSolid located;
    toSolidContacts(solid, box, pose, kReach, located, expected);
    ASSERT_EQ(found.size(), expected.size()) << i;
    for (std::size_t c = 0; c < found.size(); ++c) {
      ASSERT_EQ(found[c].point_on_a, expected[c].point_on_a) << i;
      ASSERT_EQ(found[c].normal, expected[c].normal) << i;
      ASSERT_EQ(found[c].distance, expected[c].distance) << i;
    }
    const bool is_inside = solid.contains(pose.translation);
    crossings += is_inside != was_inside;
    was_inside = is_inside;
    inside += is_inside;
    ++poses;
  }
  EXPECT_GT(inside, poses * 2 / 10);
  EXPECT_LT(inside, poses * 8 / 10);
  EXPECT_GT(crossings, 100);
}

/// Boxes in a block: some cross its surface, some are wholly inside.
TEST(FarVerticesInSolid, theTrianglesHaveThePoints) {
  std::mt19937_64 random(84);
  const ClusteredOctree a = ClusteredOctree::build(testing::boxMesh({1, 1, 1}));
  const ClusteredOctree b = ClusteredOctree::build(testing::boxMesh({0.4, 0.3, 0.2}));
  const FarVertices far_of_b = farVertices(b);
  for (const bool meet : {true, false}) {
    std::size_t contacts = 0;
    for (int i = 0; i < 500; ++i) {
      const Pose pose = testing::randomPose(random, meet ? 1.2 : 0.4);
      FarVerticesInSolid far;
      std::vector<Contact> found;
      far.find(SolidMesh(a, SolidMesh::Kind::simple), b, far_of_b, pose, meet, 0.0, found);
      contacts += found.size();
      for (const Contact& contact : found) {
        EXPECT_LT(distance(a.mesh().triangle(contact.triangle_a), contact.point_on_a), 1e-9);
        EXPECT_LT(distance(pose * b.mesh().triangle(contact.triangle_b), contact.point_on_b), 1e-9);
        EXPECT_LT(contact.distance, 0.0);
        const Vec3 way = contact.point_on_a - contact.point_on_b;
        EXPECT_LT((way - contact.distance * contact.normal).norm(), 1e-9);
        if (!meet) {
          EXPECT_EQ(contact.normal, found.front().normal);
        }
      }
    }
    EXPECT_GE(contacts, 500u) << meet;
  }
}

/// A tetrahedron in one of two blocks with a slot between them. The middle of its bounds is in the other
/// block.
TEST(FarVerticesInSolid, theMiddleOfBMayBeInAnotherPartOfA) {
  const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3::Ones()).toRotationMatrix();
  const auto blockAlong = [&](double from, double to) {
    return testing::moved(*testing::boxMesh({3, 3, 0.5 * (to - from)}),
                          {turn, turn.col(2) * 0.5 * (from + to)});
  };
  const ClusteredOctree a =
      ClusteredOctree::build(testing::joined(*blockAlong(-2.0, 0.63), *blockAlong(0.75, 2.75)));
  const ClusteredOctree b = ClusteredOctree::build(std::make_shared<const TriangleMesh>(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
      std::vector<TriangleMesh::Indices>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}));
  const SolidMesh solid_a(a, SolidMesh::Kind::simple);
  ASSERT_TRUE(solid_a.contains(b.mesh().bounds().center()));
  FarVerticesInSolid far;
  std::vector<Contact> found;
  far.find(solid_a, b, farVertices(b), Pose(), false, 0.0, found);
  EXPECT_FALSE(found.empty());
  for (const Contact& contact : found) {
    EXPECT_LT(contact.distance, 0.0);
    EXPECT_LT(contact.normal.dot(turn.col(2)), -0.9);  // out into the slot
  }
}

TEST(ThinThickness, ofClosedForms) {
  const auto thicknessOf = [](const testing::SharedMesh& mesh) {
    return thinThickness(ClusteredOctree::build(mesh));
  };
  EXPECT_NEAR(thicknessOf(testing::boxMesh({3, 2, 0.01})), 0.02, 1e-6);
  EXPECT_NEAR(thicknessOf(testing::boxMesh({1, 1, 1})), 2.0, 1e-5);
  EXPECT_NEAR(thicknessOf(testing::torus(2, 0.3, 64, 32)), 0.6, 0.02);
}

/// A box on a square of two triangles. Each is wider than the other in one direction. The corners of the
/// shared square belong to neither.
TEST(FlatContacts, ofABoxThatCrossesASquare) {
  const auto square = std::make_shared<const TriangleMesh>(
      std::vector<Vec3>{{-0.5, -0.4, 0}, {0.5, -0.4, 0}, {0.5, 0.4, 0}, {-0.5, 0.4, 0}},
      std::vector<TriangleMesh::Indices>{{0, 1, 2}, {0, 2, 3}});
  const ClusteredOctree tree = ClusteredOctree::build(square);
  std::vector<Vec3> corners;
  for (int c = 0; c < 8; ++c) {
    corners.emplace_back(c & 1 ? 0.4 : -0.4, c & 2 ? 0.5 : -0.5, c & 4 ? 0.3 : -0.3);
  }
  const ConvexHull box(corners, 0.01);
  int askew = 0;
  for (const double tilt : {0.0, 0.02, -0.02}) {
    const Pose box_in_square{Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix(), {0, 0, 0.3}};
    std::vector<Contact> found;
    contacts(tree, box, box_in_square, 0.05, found);
    ASSERT_EQ(found.size(), 2u);
    addFlatContacts(tree.mesh(), box, box_in_square, 0.05, found);
    for (const double x : {-0.4, 0.4}) {
      for (const double y : {-0.4, 0.4}) {
        const Vec3 corner(x, y, 0);
        const auto isThere = [&](const Contact& contact) {
          return (contact.point_on_a - corner).norm() < 1e-3;
        };
        const auto contact = std::ranges::find_if(found, isThere);
        ASSERT_NE(contact, found.end()) << x << ' ' << y;
        const double deepest = std::ranges::min_element(found, {}, &Contact::distance)->distance;
        EXPECT_NEAR(contact->distance, std::max(-0.01 + std::tan(tilt) * y, deepest), 1e-3);
        if (contact->distance > deepest + 1e-6) {
          ++askew;
          EXPECT_NEAR(contact->normal.z(), -1.0, 1e-12) << "the square's, although the box is askew";
        }
      }
    }
    EXPECT_LE(found.size(), 2u + 2u * 5u);
  }
  EXPECT_EQ(askew, 4);  // two corners of each tilted box
}

/// A rough mesh stands on its corners: on a flat face, all of them push along the face's normal.
TEST(FlatContacts, ofARoughMeshPushAlongTheFace) {
  std::mt19937_64 random(106);
  const testing::SharedMesh sheet = testing::waveSheet(1.0, 0.0, 40);
  std::vector<Vec3> vertices(sheet->vertices().begin(), sheet->vertices().end());
  for (Vec3& vertex : vertices) vertex.z() += testing::uniform(random, -0.002, 0.002);
  const ClusteredOctree tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(
      vertices, std::vector<TriangleMesh::Indices>(sheet->triangles().begin(), sheet->triangles().end())));
  const ConvexBox box({Vec3::Zero(), Mat3::Identity(), {0.5, 0.5, 0.2}});
  constexpr double kThreshold = 0.01, kBottom = 0.003;
  const Pose box_in_sheet{Mat3::Identity(), {0.01, 0.02, 0.2 + kBottom}};
  std::vector<Contact> found;
  contacts(tree, box, box_in_sheet, kThreshold, found);
  const std::size_t of_triangles = found.size();
  addFlatContacts(tree.mesh(), box, box_in_sheet, kThreshold, found);
  std::size_t at_corners = 0;
  for (std::size_t c = of_triangles; c < found.size(); ++c) {
    const Vec3& place = found[c].point_on_a;
    const auto isHere = [&](const Vec3& corner) { return (corner - place).norm() < 1e-12; };
    if (std::ranges::none_of(tree.mesh().triangle(found[c].triangle_a), isHere)) continue;
    ++at_corners;
    ASSERT_NEAR(found[c].normal.z(), -1.0, 1e-12);
    ASSERT_NEAR(found[c].distance, kBottom - place.z(), 1e-12);
  }
  EXPECT_GT(at_corners, 500u);
}

}  // namespace
}  // namespace octoblisk
