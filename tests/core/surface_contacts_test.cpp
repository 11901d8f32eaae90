// Tests which contacts of two triangulated surfaces are kept.
#include "contact/surface_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "octoblisk/contacts.h"
#include "query/near_pairs.h"
#include "shared/block.h"
#include "shared/brute_force.h"
#include "shared/hard_meshes.h"
#include "shared/meshes.h"
#include "shared/posed_vertices.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

auto asTuple(const Contact& c) {
  return std::tuple(c.triangle_a, c.triangle_b, c.distance, c.normal, c.point_on_a, c.point_on_b);
}

/// The contacts of two meshes before and after the filter.
struct Found {
  double threshold;
  std::vector<Contact> all, kept;

  Found(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double within)
      : threshold(within) {
    contacts(a, b, b_in_a, threshold, all);
    kept = all;
    SurfaceContacts surfaces;
    surfaces.filter(
        kept, threshold, [&](const Contact& c) { return a.mesh().triangle(c.triangle_a); },
        [&](const Contact& c) { return b_in_a * b.mesh().triangle(c.triangle_b); });
  }
};

TEST(SurfaceContacts, aBoxOverOrInAFlatFloorIsPushedUpAlone) {
  const ClusteredOctree floor = ClusteredOctree::build(testing::waveSheet(3, 0.0, 60));
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({0.5, 0.4, 0.3}));
  std::mt19937_64 random(97);
  int askew = 0;
  constexpr int kCases = 300;
  for (int i = 0; i < kCases; ++i) {
    const double height = 0.3 + uniform(random, -0.008, 0.008), tilt = uniform(random, -0.002, 0.002);
    const Pose pose{Eigen::AngleAxisd(uniform(random, 0, 3), Vec3::UnitZ()).toRotationMatrix() *
                        Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix(),
                    Vec3{uniform(random, -2, 2), uniform(random, -2, 2), height}};
    const Found found(floor, box, pose, 0.02);
    const auto isAskew = [](const Contact& c) { return std::abs(c.normal.z()) < 0.99; };
    askew += std::ranges::any_of(found.all, isAskew);
    ASSERT_FALSE(found.kept.empty());
    ASSERT_EQ(testing::deepest(found.kept), testing::deepest(found.all));
    for (const Contact& contact : found.kept) ASSERT_LT(contact.normal.z(), -0.99) << "case " << i;
  }
  EXPECT_GT(askew, kCases / 2);  // otherwise there is nothing to remove
}

/// Equal boxes on each other, hardly shifted and turned: their edges nearly coincide.
TEST(SurfaceContacts, aBoxOnAnEqualOneIsHeldAtItsFourCorners) {
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({0.5, 0.5, 0.25}));
  std::mt19937_64 random(96);
  int tilted = 0;
  constexpr int kCases = 300;
  for (int i = 0; i < kCases; ++i) {
    const auto angle = [&] { return uniform(random, -0.004, 0.004); };
    const Vec3 angles{angle(), angle(), angle()};
    const Pose pose{
        (Eigen::AngleAxisd(angles.x(), Vec3::UnitX()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()))
            .toRotationMatrix(),
        Vec3{uniform(random, -1e-3, 1e-3), uniform(random, -1e-3, 1e-3), 0.52}};
    const Found found(box, box, pose, 0.03);
    const auto tiltTo = [](const Contact& c, const Vec3& facing) { return c.normal.cross(facing).norm(); };
    // A contact of a horizontal face, tilted by less than the two faces may be.
    const auto isTilted = [&](const Contact& c) {
      const bool of_top = std::abs(unitNormal(box.mesh().triangle(c.triangle_a)).z()) > 0.5,
                 of_bottom = std::abs(unitNormal(box.mesh().triangle(c.triangle_b)).z()) > 0.5;
      const double to_top = tiltTo(c, Vec3::UnitZ()), to_bottom = tiltTo(c, pose.rotation.col(2));
      return ((of_top && to_top < 9e-3) || (of_bottom && to_bottom < 9e-3)) &&
             std::min(to_top, to_bottom) > 2e-3;
    };
    tilted += std::ranges::any_of(found.all, isTilted);
    EXPECT_TRUE(std::ranges::none_of(found.kept, isTilted)) << "case " << i;
    ASSERT_EQ(testing::deepest(found.kept), testing::deepest(found.all));
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        EXPECT_TRUE(std::ranges::any_of(
            found.kept, [&](const Contact& c) { return (c.point_on_a - Vec3(x, y, 0.25)).norm() < 0.01; }))
            << "case " << i << ", corner " << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(tilted, kCases / 2);
}

TEST(SurfaceContacts, nothingWithinTheOtherBodyHoldsItThere) {
  std::mt19937_64 random(98);
  const auto mesh = testing::bumpySphere(random, 1.0, 0.2, 24);
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  int inside_before = 0, inside_after = 0;
  constexpr int kCases = 60;
  for (int i = 0; i < kCases; ++i) {
    Pose pose = testing::randomPose(random, 0.0);
    const Vec3 direction = testing::randomRotation(random).col(0);
    pose.translation = direction * uniform(random, 1.75, 1.95);
    const Found found(tree, tree, pose, 0.04);
    if (found.all.empty() || testing::deepest(found.all) > 0.0) continue;
    // A point midway between two surfaces that have passed each other is in both solids.
    const auto isInside = [&](const Contact& c) {
      const Vec3 middle = 0.5 * (c.point_on_a + c.point_on_b);
      return c.distance > 1e-6 && testing::windingNumber(*mesh, middle) > 0.5;
    };
    const bool was_inside = std::ranges::any_of(found.all, isInside);
    inside_before += was_inside;
    inside_after += std::ranges::any_of(found.kept, isInside);
    ASSERT_EQ(testing::deepest(found.kept), testing::deepest(found.all));
  }
  EXPECT_GT(inside_before, kCases / 3);
  EXPECT_EQ(inside_after, 0);
}

/// Puts a box on top of another, upright or tilted, with its lowest face, edge or corner slightly in it.
void expectShortWays(const testing::SharedMesh& mesh_a, double top, const testing::SharedMesh& mesh_b,
                     double share_left) {
  std::mt19937_64 random(99);
  const ClusteredOctree a = ClusteredOctree::build(mesh_a), b = ClusteredOctree::build(mesh_b);
  int cases = 0, had_long_ways = 0, has_long_ways = 0;
  for (int i = 0; i < 2000; ++i) {
    const double turn = uniform(random, 0, 3), tilt = i % 3 ? uniform(random, -0.3, 0.3) : 0.0;
    const Mat3 rotation = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix() *
                          Eigen::AngleAxisd(tilt, Vec3::UnitX()).toRotationMatrix();
    Pose pose{rotation, Vec3{uniform(random, -1, 1), uniform(random, -1, 1), 0.0}};
    const double lowest = testing::lowestZ(*mesh_b, pose);
    const double depth = uniform(random, 0.002, 0.05);
    pose.translation.z() = top - lowest - depth;
    const Found found(a, b, pose, 0.0);
    if (found.all.empty()) continue;  // the lowest feature is beside A
    ++cases;
    had_long_ways += testing::deepest(found.all) < -2.0 * depth;
    has_long_ways += testing::deepest(found.kept) < -2.0 * depth;
  }
  EXPECT_GT(cases, 600);
  EXPECT_GT(had_long_ways, cases / 2);
  EXPECT_LE(has_long_ways, share_left * cases);
}

TEST(SurfaceContacts, coarseBoxesArePushedTheShortWay) {
  expectShortWays(testing::boxMesh({1.0, 0.8, 0.5}), 0.5, testing::boxMesh({0.6, 0.7, 0.9}), 0.002);
}

TEST(SurfaceContacts, aBarOverAThinPlateIsPushedTheShortWay) {
  expectShortWays(testing::boxMesh({0.01, 0.8, 0.5}), 0.5, testing::boxMesh({1.5, 0.3, 0.2}), 0.02);
}

/// A body that rocks on a face of the floor touches it with one corner. Its other corners are also near.
TEST(SurfaceContacts, cornersOfABodyThatRocksHaveContacts) {
  const auto meshOf = [](std::vector<Vec3> vertices, std::vector<TriangleMesh::Indices> triangles) {
    return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
  };
  const ClusteredOctree floor =
      ClusteredOctree::build(meshOf({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}));
  const testing::SharedMesh tetrahedron = meshOf({{0, 0.4, 0}, {-0.5, -0.3, 0}, {0.5, -0.3, 0}, {0, 0, 0.8}},
                                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  constexpr double kReach = 0.1;
  std::mt19937_64 random(104);
  int near = 0, has_contact = 0;
  for (const auto& mesh : {tetrahedron, testing::boxMesh({0.5, 0.4, 0.3})}) {
    const ClusteredOctree body = ClusteredOctree::build(mesh);
    for (int i = 0; i < 100; ++i) {
      Pose pose{
          Eigen::AngleAxisd(uniform(random, 0.0, 0.08), Vec3(std::cos(i), std::sin(i), 0)).toRotationMatrix(),
          Vec3::Zero()};
      pose.translation.z() = uniform(random, -0.01, 0.01) - testing::lowestZ(*mesh, pose);
      const Found found(floor, body, pose, kReach);
      for (const Contact& contact : found.kept) EXPECT_LT(contact.normal.z(), -0.999999) << i;
      for (const Vec3& vertex : mesh->vertices()) {
        const Vec3 corner = pose * vertex;
        if (corner.z() > kReach) continue;
        ++near;
        const auto isAtCorner = [&](const Contact& contact) {
          return (contact.point_on_b - corner).norm() < 1e-9 &&
                 std::abs(contact.distance - corner.z()) < 1e-9;
        };
        has_contact += std::ranges::any_of(found.kept, isAtCorner);
      }
    }
  }
  EXPECT_GT(near, 600);
  EXPECT_GT(has_contact,
            0.98 * near);  // none if both triangles at a corner have a lower one in the same plane
}

/// If the box is nearly parallel to the floor, contacts at the floor's internal edge push along the box's
/// face.
TEST(SurfaceContacts, cornersOverALargeFloorAreNotTooDeep) {
  const ClusteredOctree floor = ClusteredOctree::build(testing::waveSheet(50, 0.0, 1));
  const auto mesh = testing::boxMesh({0.5, 0.4, 0.3});
  const ClusteredOctree box = ClusteredOctree::build(mesh);
  std::mt19937_64 random(107);
  int at_edge = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 axis(std::cos(i), std::sin(i), 0.0);
    Pose pose{Eigen::AngleAxisd(uniform(random, 0, 1.3e-3), axis).toRotationMatrix() *
                  Eigen::AngleAxisd(uniform(random, 0, 6), Vec3::UnitZ()).toRotationMatrix(),
              Vec3::Zero()};
    const double lowest = testing::lowestZ(*mesh, pose);
    const double height = uniform(random, 0.0005, 0.002), along = uniform(random, -30, 30);
    pose.translation = Vec3(along + uniform(random, -0.3, 0.3), i % 2 ? along : -along, height - lowest);
    const Found found(floor, box, pose, 0.01);
    at_edge += std::ranges::any_of(found.all, [](const Contact& contact) {
      const double tilt = std::hypot(contact.normal.x(), contact.normal.y());
      return tilt > 1e-6 && tilt < 0.01;
    });
    for (const Contact& contact : found.kept) {
      EXPECT_GT((contact.point_on_a - contact.point_on_b).dot(contact.normal), height - 1e-5) << i;
    }
  }
  EXPECT_GT(at_edge, 200);  // otherwise all contacts push along the floor's own normal
}

TEST(SurfaceContacts, sheetsHaveTwoSides) {
  const ClusteredOctree sheet = ClusteredOctree::build(testing::waveSheet(2, 0.0, 12));
  for (const double gap : {-0.01, 0.01}) {
    for (const double turn : {0.0, std::numbers::pi}) {
      const Pose pose{Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix(), Vec3(0, 0, gap)};
      const Found found(sheet, sheet, pose, 0.02);
      ASSERT_FALSE(found.kept.empty());
      for (const Contact& contact : found.kept) {
        ASSERT_NEAR(contact.distance, 0.01, 1e-12);
        ASSERT_NEAR(contact.normal.z(), gap > 0 ? -1.0 : 1.0, 1e-9);
      }
    }
  }
}

/// A flat floor of strips, each of two triangles that are a thousand times as long as wide.
TEST(SurfaceContacts, aBoxOverNarrowStripsIsPushedUpAlone) {
  constexpr std::uint32_t kStrips = 1000;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t i = 0; i <= kStrips; ++i) {
    const double x = -1.0 + 2.0 * i / kStrips;
    vertices.insert(vertices.end(), {Vec3(x, -1.0, 0.0), Vec3(x, 1.0, 0.0)});
    if (i == kStrips) continue;
    triangles.insert(triangles.end(), {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
  }
  const ClusteredOctree floor =
      ClusteredOctree::build(std::make_shared<TriangleMesh>(std::move(vertices), std::move(triangles)));
  const ClusteredOctree box = ClusteredOctree::build(testing::boxMesh({0.1, 0.08, 0.05}));
  std::mt19937_64 random(101);
  SurfaceContacts surfaces;
  std::vector<Contact> at_once;
  for (int i = 0; i < 30; ++i) {
    const double gap = uniform(random, 1e-4, 1e-2);
    Pose pose = testing::randomPose(random, 0.0);
    const double lowest = testing::lowestZ(box.mesh(), pose);
    pose.translation = Vec3(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), gap - lowest);
    const Found found(floor, box, pose, 2.0 * gap);
    surfaces.find(floor, box, pose, found.threshold, found.threshold, at_once);
    ASSERT_GT(found.all.size(), found.kept.size());
    for (const auto& contacts : {found.kept, at_once}) {
      ASSERT_FALSE(contacts.empty());
      for (const Contact& contact : contacts) ASSERT_LT(contact.normal.z(), -0.99) << "case " << i;
    }
  }
}

/// Around a tip, single precision sees all corners at one place.
TEST(SurfaceContacts, aTipTooFineForSinglePrecisionIsFound) {
  const auto large = std::make_shared<TriangleMesh>(std::vector<Vec3>{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}},
                                                    std::vector<TriangleMesh::Indices>{{0, 1, 2}});
  const ClusteredOctree a = ClusteredOctree::build(large);
  std::mt19937_64 random(102);
  SurfaceContacts surfaces;
  std::vector<Contact> found;
  for (int i = 0; i < 2000; ++i) {
    const double height = std::pow(10.0, uniform(random, -11, -8));
    std::vector<Vec3> vertices = {{0, 0, 0.1}};
    for (int c = 0; c < 3; ++c) {
      vertices.emplace_back(Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, 0.1, 1)) *
                                height +
                            vertices[0]);
    }
    const auto tip = std::make_shared<TriangleMesh>(
        std::move(vertices), std::vector<TriangleMesh::Indices>{{1, 2, 0}, {2, 3, 0}, {3, 1, 0}});
    const ClusteredOctree b = ClusteredOctree::build(tip);
    surfaces.find(a, b, Pose(), 0.2, 0.2, found);
    ASSERT_FALSE(found.empty()) << "case " << i;
    ASSERT_NEAR(testing::deepest(found), 0.1, 1e-14);
  }
}

/// On meshes with every defect, of any size, the deepest contact stays.
TEST(SurfaceContacts, theDeepestContactOfHardMeshesIsFound) {
  std::mt19937_64 random(103);
  const auto hardMesh = [&](double size) {
    const auto kind = static_cast<testing::MeshKind>(random() % testing::kMeshKinds);
    return testing::scaledAndMoved(testing::hardMesh(random, kind), size,
                                   testing::randomPoint(random, 10.0 * size));
  };
  int clear = 0, meeting = 0;
  SurfaceContacts surfaces;
  std::vector<Contact> at_once;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10.0, uniform(random, -6, 6));
    const ClusteredOctree a = ClusteredOctree::build(hardMesh(size)),
                          b = ClusteredOctree::build(hardMesh(size));
    Pose pose{testing::randomRotation(random), Vec3::Zero()};
    const Vec3 away = testing::randomRotation(random).col(0) * uniform(random, 0.0, 3.0) * size;
    pose.translation = a.mesh().bounds().center() - pose * b.mesh().bounds().center() + away;
    const Found found(a, b, pose, size * std::pow(10.0, uniform(random, -3, 0)));
    surfaces.find(a, b, pose, found.threshold, found.threshold, at_once);
    ASSERT_EQ(at_once.empty(), found.kept.empty()) << "case " << i;
    if (at_once.empty()) continue;
    ASSERT_EQ(testing::deepest(at_once), testing::deepest(found.kept)) << "case " << i;
    ++(testing::deepest(found.all) > 0.0 ? clear : meeting);
  }
  EXPECT_GT(clear, 150);
  EXPECT_GT(meeting, 500);
}

/// On ordinary bodies, leaving out triangle pairs makes no difference.
TEST(SurfaceContacts, contactsFoundAtOnceEqualFilteredOnes) {
  std::mt19937_64 random(100);
  const std::vector<testing::SharedMesh> meshes = {
      testing::bumpySphere(random, 1.0, 0.2, 24), testing::torus(1.0, 0.4, 24, 16),
      testing::boxMesh({0.8, 0.5, 0.3}), testing::waveSheet(3, 0.2, 60)};
  std::vector<ClusteredOctree> trees;
  for (const testing::SharedMesh& mesh : meshes) trees.push_back(ClusteredOctree::build(mesh));
  int clear = 0, meeting = 0, filtered = 0;
  SurfaceContacts surfaces;
  std::vector<Contact> at_once;
  for (std::size_t i = 0; i < 2000; ++i) {
    const ClusteredOctree &a = trees[i % 4], &b = trees[i / 4 % 4];
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = testing::randomRotation(random).col(0) * uniform(random, 1.4, 2.8);
    const Found found(a, b, pose, uniform(random, 0.01, 0.2));
    surfaces.find(a, b, pose, found.threshold, found.threshold, at_once);
    ASSERT_TRUE(std::ranges::equal(at_once, found.kept, {}, asTuple, asTuple)) << "case " << i;
    if (found.all.empty()) continue;
    ++(testing::deepest(found.all) > 0.0 ? clear : meeting);
    filtered += 2 * found.kept.size() < found.all.size();
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(meeting, 200);
  EXPECT_GT(filtered, 400);
}

/// Where very many pairs are within the threshold, the threshold shrinks, and nothing else changes.
TEST(SurfaceContacts, fineMeshesHaveTheContactsOfASmallerThreshold) {
  std::mt19937_64 random(105);
  const ClusteredOctree tree = ClusteredOctree::build(testing::torus(1.0, 0.35, 60, 30));
  int reduced = 0, clear = 0, meeting = 0;
  SurfaceContacts surfaces;
  std::vector<Contact> at_once;
  std::vector<NearPair> near;
  for (int i = 0; i < 30; ++i) {
    Pose pose{Mat3(Eigen::AngleAxisd(uniform(random, 0.0, 3.0), Vec3::UnitZ())), Vec3::Zero()};
    pose.translation =
        Vec3(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), uniform(random, 0.6, 0.8));
    const double threshold = uniform(random, 0.1, 0.2);
    const double reach = nearPairs(treeOf(tree), treeOf(tree), pose, threshold, 0.1 * threshold, near);
    surfaces.find(tree, tree, pose, threshold, 0.1 * threshold, at_once);
    const Found found(tree, tree, pose, reach);
    ASSERT_TRUE(std::ranges::equal(at_once, found.kept, {}, asTuple, asTuple)) << "case " << i;
    ASSERT_FALSE(at_once.empty());
    reduced += reach < threshold;
    ++(testing::deepest(found.all) > 0.0 ? clear : meeting);
  }
  EXPECT_GT(reduced, 20);
  EXPECT_GT(clear, 5);
  EXPECT_GT(meeting, 10);
}

}  // namespace
}  // namespace octoblisk
