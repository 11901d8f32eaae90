// Contacts by features of sheets: closed forms, and brute force over all triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "contact/feature_contacts.h"
#include "core/solid.h"
#include "octoblisk/distance.h"
#include "shared/body_contacts.h"
#include "shared/brute_force.h"
#include "shared/hard_meshes.h"
#include "shared/meshes.h"
#include "shared/posed_vertices.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::boxMesh;
using testing::uniform;
using testing::waveSheet;
using Kind = SolidMesh::Kind;

/// A mesh with its features, as a sheet or as what its surface bounds.
struct Piece {
  explicit Piece(testing::SharedMesh shared) : solid(std::move(shared)), features(SolidMesh(solid.surface)) {}
  Piece(testing::SharedMesh shared, Kind kind)
      : solid(std::move(shared)), features(SolidMesh(solid.tree, kind)) {}
  const TriangleMesh& mesh() const { return *solid.mesh; }

  Solid solid;
  MeshFeatures features;
};

testing::SharedMesh meshOf(std::vector<Vec3> vertices, std::vector<TriangleMesh::Indices> triangles) {
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

Mat3 turn(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

std::vector<Contact> contactsWith(const Piece& a, const Piece& b, const Pose& b_in_a, double reach,
                                  const std::optional<Pose>& when_apart = {}) {
  std::vector<Contact> found;
  FeatureContacts().find(a.features, b.features, b_in_a, when_apart, reach, reach, found);
  return found;
}

/// A contact of a sheet and a body, in the sheet's frame.
struct Push {
  Vec3 direction;  ///< in which it pushes the body
  Vec3 of_sheet, of_body;
  double distance;
};

/// The contacts of a sheet (A) and a body (B); if `is_swapped`, found with the body as A.
std::vector<Push> pushesOn(const Piece& sheet, const Piece& body, const Pose& body_in_sheet, double reach,
                           const std::optional<Pose>& when_apart = {}, bool is_swapped = false) {
  std::vector<Push> pushes;
  if (is_swapped) {
    std::optional<Pose> sheet_when_apart;
    if (when_apart) sheet_when_apart = when_apart->inverse();
    for (const Contact& c : contactsWith(body, sheet, body_in_sheet.inverse(), reach, sheet_when_apart)) {
      pushes.push_back({body_in_sheet.rotation * c.normal, body_in_sheet * c.point_on_b,
                        body_in_sheet * c.point_on_a, c.distance});
    }
  } else {
    for (const Contact& c : contactsWith(sheet, body, body_in_sheet, reach, when_apart))
      pushes.push_back({-c.normal, c.point_on_a, c.point_on_b, c.distance});
  }
  return pushes;
}

/// How far a mesh extends from its origin along a direction of the frame in which it is turned.
double extentAlong(const TriangleMesh& mesh, const Mat3& rotation, const Vec3& direction) {
  double extent = -std::numeric_limits<double>::infinity();
  for (const Vec3& vertex : mesh.vertices()) extent = std::max(extent, direction.dot(rotation * vertex));
  return extent;
}

Mat3 tilted(std::mt19937_64& random, double most) {
  const double toward = uniform(random, 0.0, 6.3);
  return turn(uniform(random, 0.0, most), {std::cos(toward), std::sin(toward), 0.0}) *
         turn(uniform(random, 0.0, 6.3), Vec3::UnitZ());
}

/// A box through a flat sheet, by much more than the reach. Each corner past it is pushed back as far as it
/// is past. Known from before or not, its side is that of most of it, or the one from where it came.
TEST(SheetContacts, aBoxThroughAFlatSheetIsPushedBackByExactHeights) {
  const Piece sheets[] = {Piece(waveSheet(3, 0.0, 60), Kind::sheet), Piece(waveSheet(3, 0.0, 60)),
                          Piece(waveSheet(3, 0.0, 1), Kind::sheet)};
  const Piece box(boxMesh({0.5, 0.4, 0.3}));
  constexpr double kReach = 0.01;
  std::mt19937_64 random(80);
  int beyond_reach = 0, mostly_through = 0;
  constexpr int kCases = 1200;
  for (int i = 0; i < kCases; ++i) {
    const Piece& sheet = sheets[i % 3];
    const Vec3 up = (i / 3 % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitZ();  // to the body's side
    const bool is_swapped = i / 6 % 2 == 0, is_known = i / 12 % 2 == 0;
    const Mat3 rotation = tilted(random, i % 5 == 0 ? 0.0 : 0.25);
    const double lowest = extentAlong(box.mesh(), rotation, -up);
    const double height =
        is_known ? uniform(random, -0.15, lowest - 0.001) : uniform(random, 0.02, lowest - 0.001);
    const Vec3 beside(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
    const Pose pose{rotation, beside + height * up};
    std::optional<Pose> before;
    if (is_known) before = Pose{rotation, beside + (lowest + 0.05) * up};
    const std::vector<Push> pushes = pushesOn(sheet, box, pose, kReach, before, is_swapped);
    for (const Push& push : pushes) {
      ASSERT_GT(push.direction.dot(up), 0.0) << i << ": " << push.distance;
      ASSERT_LT((push.of_body - push.of_sheet - push.distance * push.direction).norm(), 1e-9) << i;
    }
    for (const Vec3& vertex : box.mesh().vertices()) {
      const Vec3 corner = pose * vertex;
      const double over = corner.dot(up);
      if (over >= 0.0) continue;
      ASSERT_TRUE(std::ranges::any_of(pushes,
                                      [&](const Push& push) {
                                        return (push.of_body - corner).norm() < 1e-9 &&
                                               std::abs(push.distance - over) < 1e-9;
                                      }))
          << i << ": " << over;
      beyond_reach += over < -2.0 * kReach;
    }
    mostly_through += height < -0.01;
  }
  EXPECT_GT(beyond_reach, 2 * kCases);
  EXPECT_GT(mostly_through, kCases / 10);
}

/// The same box in the same place, whose middle has just passed the sheet: what is known of it decides.
TEST(SheetContacts, whereABoxCameFromMattersMoreThanItsMiddle) {
  const Piece sheet(waveSheet(3, 0.0, 24), Kind::sheet), box(boxMesh({0.5, 0.4, 0.3}));
  std::mt19937_64 random(81);
  for (int i = 0; i < 200; ++i) {
    const Mat3 rotation = tilted(random, 0.1);
    const double middle = (i % 2 == 0 ? 1.0 : -1.0) * uniform(random, 0.01, 0.15);
    const Vec3 beside(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
    const Pose pose{rotation, beside + Vec3(0, 0, middle)};
    const auto side = [&](const std::optional<Pose>& before) {
      const std::vector<Push> pushes = pushesOn(sheet, box, pose, 0.02, before, i / 2 % 2 == 0);
      EXPECT_GE(pushes.size(), 4u) << i;
      const auto up = std::ranges::count_if(pushes, [](const Push&push) { return push.direction.z() > 0.9; }),
                 down =
                     std::ranges::count_if(pushes, [](const Push&push) { return push.direction.z() < -0.9; });
      EXPECT_EQ(static_cast<std::size_t>(up + down), pushes.size()) << i;
      EXPECT_TRUE(up == 0 || down == 0) << i;
      return up > 0 ? 1.0 : -1.0;
    };
    ASSERT_EQ(side({}), middle > 0.0 ? 1.0 : -1.0) << i;
    ASSERT_EQ(side(Pose{rotation, beside + Vec3(0, 0, 0.7)}), 1.0) << i;
    ASSERT_EQ(side(Pose{rotation, beside - Vec3(0, 0, 0.7)}), -1.0) << i;
  }
}

/// Over or under a flat sheet, or slightly through it.
TEST(SheetContacts, aBoxOverOrInAFlatFloorIsPushedUpAlone) {
  const Piece floor(waveSheet(3, 0.0, 60), Kind::sheet), box(boxMesh({0.5, 0.4, 0.3}));
  std::mt19937_64 random(97);
  int clear = 0, meeting = 0;
  for (int i = 0; i < 600; ++i) {
    const Vec3 up = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitZ();
    const double height = 0.3 + uniform(random, -0.008, 0.008);
    const Pose pose{
        turn(uniform(random, -0.002, 0.002), Vec3::UnitX()) * turn(uniform(random, 0, 3), Vec3::UnitZ()),
        Vec3(uniform(random, -2, 2), uniform(random, -2, 2), 0.0) + height * up};
    const std::vector<Push> pushes = pushesOn(floor, box, pose, 0.02, {}, i / 2 % 2 == 0);
    int at_corners = 0;
    for (const Push& push : pushes) {
      ASSERT_GT(push.direction.dot(up), 0.99) << i;
      at_corners += std::ranges::any_of(box.mesh().vertices(), [&](const Vec3& vertex) {
        const Vec3 corner = pose * vertex;
        return (corner - push.of_body).norm() < 1e-9 && std::abs(corner.dot(up) - push.distance) < 1e-9;
      });
    }
    ASSERT_GE(at_corners, 4) << i;
    const double lowest = height - extentAlong(box.mesh(), pose.rotation, -up);
    ++(height - extentAlong(box.mesh(), pose.rotation, -up) > 0.0 ? clear : meeting);
    const auto nearest = std::ranges::min_element(pushes, {}, &Push::distance);
    ASSERT_NEAR(nearest->distance, lowest, 1e-9) << i;
  }
  EXPECT_GT(clear, 150);
  EXPECT_GT(meeting, 150);
}

/// On waves, from both sides. A corner is as deep as a ray along its normal says, by brute force.
TEST(SheetContacts, aBoxOnWavesIsPushedToItsSide) {
  const Piece waves(waveSheet(3, 0.2, 24), Kind::sheet), box(boxMesh({0.5, 0.4, 0.3}));
  constexpr double kReach = 0.02;
  std::mt19937_64 random(82);
  int past = 0, clear = 0, meeting = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 up = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitZ();
    const bool is_known = i / 4 % 2 == 0;
    const Mat3 rotation = tilted(random, 0.2);
    const Vec3 beside(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
    const Pose far{rotation, beside + 2.0 * up};
    const Clearance start = distance(waves.solid.tree, box.solid.tree, far);
    // Down to about the surface, or into it.
    Pose pose = far;
    for (Clearance gap = start; gap.found() && gap.distance > 1e-3;
         gap = distance(waves.solid.tree, box.solid.tree, pose))
      pose.translation -= gap.distance * up;
    pose.translation -= uniform(random, -kReach, 0.1) * up;
    const std::vector<Push> pushes =
        pushesOn(waves, box, pose, kReach, is_known ? std::optional(far) : std::nullopt, i / 2 % 2 == 0);
    const bool do_meet = !testing::bruteForcePairs(waves.mesh(), box.mesh(), pose).empty();
    ++(do_meet ? meeting : clear);
    ASSERT_TRUE(!do_meet || !pushes.empty()) << i;
    for (const Push& push : pushes) {
      ASSERT_GT(push.direction.dot(up), 0.0) << i << ": " << push.distance;
      const bool is_corner = std::ranges::any_of(box.mesh().vertices(), [&](const Vec3& vertex) {
        return (pose * vertex - push.of_body).norm() < 1e-9;
      });
      if (!is_corner || push.distance > -kReach) continue;
      ++past;
      ASSERT_LT(testing::bruteForceDistance(waves.mesh(), push.of_sheet), 1e-9) << i;
    }
  }
  EXPECT_GT(clear, 30);
  EXPECT_GT(meeting, 100);
  EXPECT_GT(past, 50);
}

/// Fine bodies pressed through a flat sheet by more than the reach and than their triangles. Of a body that
/// is locally a sphere, the first corner downhill that can be pushed is not much higher than the lowest: its
/// slope is at most a tenth, or that of a triangle.
TEST(SheetContacts, aFineBodyThroughASheetIsPushedBackAtItsDeepest) {
  std::mt19937_64 random(83);
  const Piece bodies[] = {Piece(testing::bumpySphere(random, 1.0, 0.0, 40)),
                          Piece(testing::torus(1.0, 0.4, 48, 32))};
  const double radius[] = {1.0, 1.4};  // the greatest of curvature
  const Piece sheets[] = {Piece(waveSheet(3, 0.0, 40), Kind::sheet),
                          Piece(waveSheet(3, 0.0, 1), Kind::sheet)};
  constexpr double kReach = 0.01;
  FeatureContacts contacts;
  std::vector<Contact> found;
  int many = 0;
  for (int i = 0; i < 300; ++i) {
    const Piece &body = bodies[i % 2], &sheet = sheets[i / 2 % 2];
    const Vec3 up = (i / 4 % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitZ();
    const Mat3 rotation = testing::randomRotation(random);
    const double lowest = extentAlong(body.mesh(), rotation, -up);
    const double depth = uniform(random, 0.05, 0.9 * lowest);
    const Pose pose{rotation,
                    Vec3(uniform(random, -1, 1), uniform(random, -1, 1), 0.0) + (lowest - depth) * up};
    contacts.find(sheet.features, body.features, pose, {}, kReach, kReach, found);
    double deepest = 0.0;
    for (const Contact& contact : found) {
      ASSERT_GT(-contact.normal.dot(up), 0.0) << i << ": " << contact.distance;
      const auto& vertices = body.mesh().vertices();
      const auto vertex = std::ranges::find_if(
          vertices, [&](const Vec3& v) { return (pose * v - contact.point_on_b).norm() < 1e-9; });
      if (vertex == vertices.end() || contact.distance > -2.0 * kReach) continue;
      ASSERT_NEAR((pose * *vertex).dot(up), contact.distance, 1e-9) << i;  // its exact height
      deepest = std::min(deepest, contact.distance);
      many += contact.distance < -0.2;
    }
    const double short_by = (depth + deepest) / radius[i % 2];
    ASSERT_LT(short_by, 0.01) << i << ": " << depth;
  }
  EXPECT_GT(many, 300);
}

/// A body that rocks on a face of the floor touches it with one corner. Its other corners are also near.
TEST(SheetContacts, cornersOfABodyThatRocksHaveContacts) {
  const Piece floor(meshOf({{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}), Kind::sheet);
  const testing::SharedMesh tetrahedron = meshOf({{0, 0.4, 0}, {-0.5, -0.3, 0}, {0.5, -0.3, 0}, {0, 0, 0.8}},
                                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  constexpr double kReach = 0.1;
  std::mt19937_64 random(104);
  int near = 0;
  for (const auto& mesh : {tetrahedron, boxMesh({0.5, 0.4, 0.3})}) {
    const Piece body(mesh);
    for (int i = 0; i < 200; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;  // or hangs under it
      const Mat3 to_side = turn(side > 0.0 ? 0.0 : std::numbers::pi, Vec3::UnitX());
      Pose pose{turn(uniform(random, 0.0, 0.08), {std::cos(i), std::sin(i), 0}), Vec3::Zero()};
      pose.translation.z() = uniform(random, -0.01, 0.01) - testing::lowestZ(*mesh, pose);
      pose = Pose{to_side, Vec3::Zero()} * pose;
      const std::vector<Push> pushes = pushesOn(floor, body, pose, kReach, {}, i / 2 % 2 == 0);
      for (const Push& push : pushes) ASSERT_GT(side * push.direction.z(), 0.999999) << i;
      for (const Vec3& vertex : mesh->vertices()) {
        const Vec3 corner = pose * vertex;
        if (side * corner.z() > kReach) continue;
        ++near;
        ASSERT_TRUE(std::ranges::any_of(pushes, [&](const Push& push) {
          return (push.of_body - corner).norm() < 1e-9 && std::abs(push.distance - side * corner.z()) < 1e-9;
        })) << i;
      }
    }
  }
  EXPECT_GT(near, 1200);
}

/// A box that is nearly parallel to two large triangles, over the edge between them.
TEST(SheetContacts, cornersOverALargeFloorAreNotTooDeep) {
  const Piece floor(waveSheet(50, 0.0, 1), Kind::sheet), box(boxMesh({0.5, 0.4, 0.3}));
  std::mt19937_64 random(107);
  for (int i = 0; i < 500; ++i) {
    const Vec3 axis(std::cos(i), std::sin(i), 0.0);
    Pose pose{turn(uniform(random, 0, 1.3e-3), axis) * turn(uniform(random, 0, 6), Vec3::UnitZ()),
              Vec3::Zero()};
    const double lowest = testing::lowestZ(box.mesh(), pose);
    const double height = uniform(random, 0.0005, 0.002), along = uniform(random, -30, 30);
    pose.translation = Vec3(along + uniform(random, -0.3, 0.3), i % 2 ? along : -along, height - lowest);
    const std::vector<Push> pushes = pushesOn(floor, box, pose, 0.01, {}, i / 2 % 2 == 0);
    double least = std::numeric_limits<double>::infinity();
    for (const Push& push : pushes) {
      ASSERT_GT((push.of_body - push.of_sheet).dot(push.direction), height - 1e-9) << i;
      least = std::min(least, push.distance);
    }
    ASSERT_NEAR(least, height, 1e-9) << i;
  }
}

/// A flat floor of strips, each of two triangles that are a thousand times as long as wide.
TEST(SheetContacts, aBoxOverNarrowStripsIsPushedUpAlone) {
  constexpr std::uint32_t kStrips = 1000;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t i = 0; i <= kStrips; ++i) {
    const double x = -1.0 + 2.0 * i / kStrips;
    vertices.insert(vertices.end(), {Vec3(x, -1.0, 0.0), Vec3(x, 1.0, 0.0)});
    if (i == kStrips) continue;
    triangles.insert(triangles.end(), {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
  }
  const Piece floor(meshOf(std::move(vertices), std::move(triangles)), Kind::sheet);
  const Piece box(boxMesh({0.1, 0.08, 0.05}));
  std::mt19937_64 random(101);
  for (int i = 0; i < 100; ++i) {
    const double gap = uniform(random, 1e-4, 1e-2);
    Pose pose = testing::randomPose(random, 0.0);
    const double lowest = testing::lowestZ(box.mesh(), pose);
    pose.translation = Vec3(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5), gap - lowest);
    const std::vector<Push> pushes = pushesOn(floor, box, pose, 2.0 * gap, {}, i % 2 == 0);
    ASSERT_FALSE(pushes.empty()) << i;
    for (const Push& push : pushes) ASSERT_GT(push.direction.z(), 0.99) << i;
    ASSERT_NEAR(std::ranges::min_element(pushes, {}, &Push::distance)->distance, gap, 1e-9) << i;
  }
}

TEST(SheetContacts, sheetsHaveTwoSides) {
  const Piece sheet(waveSheet(2, 0.0, 12), Kind::sheet);
  for (const double gap : {-0.01, 0.01}) {
    for (const double half_turn : {0.0, std::numbers::pi}) {
      for (const double yaw : {0.0, 0.3}) {
        const Pose pose{turn(half_turn, Vec3::UnitX()) * turn(yaw, Vec3::UnitZ()), Vec3(0.01, 0.02, gap)};
        const auto found = contactsWith(sheet, sheet, pose, 0.02);
        ASSERT_GT(found.size(), 200u);
        for (const Contact& contact : found) {
          ASSERT_NEAR(contact.distance, 0.01, 1e-12);
          ASSERT_NEAR(contact.normal.z(), gap > 0 ? -1.0 : 1.0, 1e-9);
        }
      }
    }
  }
}

/// A square of two triangles whose rim through its corners 0 and 1 has the middle `middle`.
testing::SharedMesh squareAt(const Vec3& middle, const Vec3& along_rim, const Vec3& away, bool is_turned) {
  std::vector<Vec3> corners = {middle - along_rim, middle + along_rim, middle + along_rim + 2.0 * away,
                               middle - along_rim + 2.0 * away};
  if (is_turned) return meshOf(std::move(corners), {{0, 2, 1}, {0, 3, 2}});
  return meshOf(std::move(corners), {{0, 1, 2}, {0, 2, 3}});
}

/// Two rims that cross at an angle, apart along their perpendicular or past each other. Each sheet leads away
/// from the other.
TEST(SheetContacts, rimsThatCrossPushAlongTheirPerpendicular) {
  std::mt19937_64 random(84);
  int clear = 0, past = 0;
  for (int i = 0; i < 1000; ++i) {
    const Mat3 frame = testing::randomRotation(random);
    const Vec3 up = frame.col(2);
    const double angle = uniform(random, 0.1, std::numbers::pi - 0.1), gap = uniform(random, -0.04, 0.08);
    const Vec3 rim_a = frame.col(0), rim_b = turn(angle, up) * rim_a;
    const auto away = [&](const Vec3& rim, double sense) {
      return Vec3(turn(uniform(random, -1.3, 1.3), rim) * (sense * up));
    };
    const Vec3 place = testing::randomPoint(random, 1.0), along(uniform(random, -0.5, 0.5), 0, 0);
    const Piece a(squareAt(place + uniform(random, -0.5, 0.5) * rim_a, rim_a, away(rim_a, -1.0), i % 2 == 0),
                  Kind::sheet);
    const Piece b(
        squareAt(gap * up + uniform(random, -0.5, 0.5) * rim_b, rim_b, away(rim_b, 1.0), i / 2 % 2 == 0),
        Kind::sheet);
    const Pose pose{Mat3::Identity(), place};
    const bool do_meet = !testing::bruteForcePairs(a.mesh(), b.mesh(), pose).empty();
    ASSERT_EQ(do_meet, gap < 0.0) << i;
    const auto found = contactsWith(a, b, pose, 0.1);
    const auto isOfRims = [&](const Contact& contact) {
      return std::abs(contact.distance - gap) < 1e-9 && (contact.normal + up).norm() < 1e-9 &&
             (contact.point_on_a - place).norm() < 1e-9 &&
             (contact.point_on_b - place - gap * up).norm() < 1e-9;
    };
    ASSERT_TRUE(std::ranges::any_of(found, isOfRims)) << i << ": " << gap;
    if (!do_meet) {
      for (const Contact& contact : found) ASSERT_GT(contact.distance, 0.99 * gap) << i;
    }
    ++(do_meet ? past : clear);
  }
  EXPECT_GT(clear, 500);
  EXPECT_GT(past, 200);
}

/// A rim over a face, seen from either side of it.
TEST(SheetContacts, aRimOverAFaceIsAsHighAsItsEnds) {
  const Piece floor(waveSheet(4, 0.0, 8), Kind::sheet);
  constexpr double kApart = 0.01;
  std::mt19937_64 random(85);
  for (int i = 0; i < 500; ++i) {
    const Vec3 up = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitZ();
    const Vec3 rim = turn(uniform(random, 0.0, 6.3), up) * Vec3::UnitX(),
               away = turn(uniform(random, -1.2, 1.2), rim) * up;
    const double gap = uniform(random, -0.04, 0.08);
    const Vec3 middle(uniform(random, -2.0, 2.0), uniform(random, -2.0, 2.0), 0.0);
    const Piece sheet(squareAt(Vec3::Zero(), rim, away, i / 2 % 2 == 0), Kind::sheet);
    std::optional<Pose> before;  // where sheets cross, nothing else tells which of them is through
    if (gap < 0.0) before = Pose{Mat3::Identity(), middle + kApart * up};
    const std::vector<Push> pushes =
        pushesOn(floor, sheet, {Mat3::Identity(), middle + gap * up}, 0.1, before, i / 4 % 2 == 0);
    for (const Push& push : pushes) {
      ASSERT_GT(push.direction.dot(up), gap < 0.0 ? 0.0 : 1.0 - 1e-9) << i;
      ASSERT_GT(push.distance, (gap < 0.0 ? gap - kApart : gap) - 1e-9) << i;  // nothing has moved farther
    }
    for (const double end : {-1.0, 1.0}) {
      ASSERT_TRUE(std::ranges::any_of(pushes,
                                      [&](const Push& push) {
                                        return (push.of_body - middle - gap * up - end * rim).norm() < 1e-9 &&
                                               std::abs(push.distance - gap) < 1e-9;
                                      }))
          << i << ": " << gap;
    }
  }
}

/// Two squares that meet in an edge along y, at the origin; each falls by `slope` away from it.
testing::SharedMesh foldOf(double slope, bool is_turned) {
  std::vector<Vec3> vertices = {{0, -1, 0},     {0, 1, 0},        {1, -1, -slope},
                                {1, 1, -slope}, {-1, -1, -slope}, {-1, 1, -slope}};
  if (is_turned) return meshOf(std::move(vertices), {{0, 1, 2}, {1, 3, 2}, {1, 0, 4}, {1, 4, 5}});
  return meshOf(std::move(vertices), {{0, 2, 1}, {1, 2, 3}, {1, 4, 0}, {1, 5, 4}});
}

/// A fold is convex from one side, whichever way its triangles face. Another fold or a box's edge crosses it
/// there.
TEST(SheetContacts, foldsAreTouchedFromTheSideWhereTheyAreConvex) {
  const Piece box(testing::moved(*boxMesh({0.5, 0.5, 0.5}),
                                 {turn(std::numbers::pi / 4.0, Vec3::UnitX()), Vec3(0, 0, std::sqrt(0.5))}));
  std::mt19937_64 random(86);
  int clear = 0, past = 0;
  for (int i = 0; i < 800; ++i) {
    const double gap = uniform(random, -0.04, 0.08);
    const Piece fold(foldOf(uniform(random, 0.3, 1.5), i % 2 == 0), Kind::sheet);
    const bool is_box = i / 2 % 2 == 0;
    std::optional<Piece> other_fold;
    if (!is_box) other_fold.emplace(foldOf(uniform(random, 0.3, 1.5), i / 4 % 2 == 0), Kind::sheet);
    const Piece& other = is_box ? box : *other_fold;
    // The box's edge is along x; the other fold is turned upside down, along y.
    const Mat3 over =
        is_box ? Mat3(Mat3::Identity())
               : Mat3(turn(std::numbers::pi / 2.0, Vec3::UnitZ()) * turn(std::numbers::pi, Vec3::UnitY()));
    const Pose pose{turn(uniform(random, -0.4, 0.4), Vec3::UnitZ()) * over,
                    Vec3(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), gap)};
    const bool do_meet = !testing::bruteForcePairs(fold.mesh(), other.mesh(), pose).empty();
    ASSERT_EQ(do_meet, gap < 0.0) << i;
    const std::vector<Push> pushes = pushesOn(fold, other, pose, 0.1, {}, i / 8 % 2 == 0);
    const auto isOfFold = [&](const Push& push) {
      return std::abs(push.distance - gap) < 1e-9 && (push.direction - Vec3::UnitZ()).norm() < 1e-9 &&
             std::hypot(push.of_sheet.x(), push.of_sheet.z()) < 1e-9;
    };
    ASSERT_TRUE(std::ranges::any_of(pushes, isOfFold)) << i << ": " << gap;
    for (const Push& push : pushes) ASSERT_GT(push.direction.z(), 0.0) << i;
    ++(do_meet ? past : clear);
  }
  EXPECT_GT(clear, 400);
  EXPECT_GT(past, 150);
}

/// Random pairs of sheets, and of a solid and a sheet, apart and meeting.
TEST(SheetContacts, ofRandomSheets_vs_bruteForce) {
  std::mt19937_64 random(87);
  const Piece pieces[] = {Piece(testing::torus(1.0, 0.4, 9, 6), Kind::sheet),
                          Piece(testing::fan(4, 2), Kind::sheet),
                          Piece(waveSheet(1.5, 0.4, 5), Kind::sheet),
                          Piece(boxMesh({0.9, 0.7, 0.5}), Kind::sheet),
                          Piece(boxMesh({0.9, 0.7, 0.5})),
                          Piece(testing::torus(1.0, 0.4, 9, 6))};
  constexpr int kSheets = 4, kPieces = 6, kCases = 3000;
  constexpr double kReach = 0.1;
  FeatureContacts contacts;
  std::vector<Contact> found;
  int hits = 0, misses = 0, meeting = 0;
  for (int i = 0; i < kCases; ++i) {
    const bool is_swapped = i % 2 == 0;
    const Piece &sheet = pieces[i / 2 % kSheets], &other = pieces[i / 2 / kSheets % kPieces];
    const Piece &a = is_swapped ? other : sheet, &b = is_swapped ? sheet : other;
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = 6.0 * testing::randomRotation(random).col(0);
    const Clearance start = distance(a.solid.tree, b.solid.tree, pose);
    const double gap = uniform(random, -0.15, 0.2);
    pose.translation += (1.0 - gap / start.distance) * (start.point_on_a - start.point_on_b);
    std::optional<Pose> before;
    if (i / 5 % 2 == 0)
      before =
          Pose{pose.rotation, pose.translation + 0.3 * (start.point_on_b - start.point_on_a).normalized()};
    // What has no effect may be wrong, so there are cases where everything has.
    const double spacing = i / 3 % 2 == 0 ? kReach : 1e-5, not_felt = spacing / 40.0;
    contacts.find(a.features, b.features, pose, before, kReach, spacing, found);
    ASSERT_EQ(testing::faultOfContacts(a.mesh(), b.mesh(), pose, kReach, not_felt, not_felt + 1e-6, found),
              "")
        << i << ": " << gap;
    ++(found.empty() ? misses : hits);
    meeting += !found.empty() && testing::deepest(found) <= 0.0;
  }
  EXPECT_GT(misses, kCases / 5);
  EXPECT_GT(hits, kCases / 2);
  EXPECT_GT(meeting, kCases / 4);
}

/// On meshes with every defect, of any size, as sheets. Meshes that are closed may also be solids.
TEST(SheetContacts, theDeepestContactOfHardMeshesIsFound) {
  std::mt19937_64 random(103);
  const auto hardMesh = [&](double size) {
    const auto kind = static_cast<testing::MeshKind>(random() % testing::kMeshKinds);
    return testing::scaledAndMoved(testing::hardMesh(random, kind), size,
                                   testing::randomPoint(random, 10.0 * size));
  };
  int clear = 0, meeting = 0, none = 0;
  FeatureContacts contacts;
  std::vector<Contact> found;
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10.0, uniform(random, -6, 6));
    const Piece a(hardMesh(size), Kind::sheet), b(hardMesh(size), Kind::sheet);
    Pose pose{testing::randomRotation(random), Vec3::Zero()};
    const Vec3 away = testing::randomRotation(random).col(0) * uniform(random, 0.0, 4.0) * size;
    pose.translation = a.mesh().bounds().center() - pose * b.mesh().bounds().center() + away;
    const double reach = size * std::pow(10.0, uniform(random, -2, 0));
    const double spacing = i % 2 == 0 ? reach : 1e-5 * size, not_felt = spacing / 40.0;
    contacts.find(a.features, b.features, pose, {}, reach, spacing, found);
    ASSERT_EQ(
        testing::faultOfContacts(a.mesh(), b.mesh(), pose, reach, not_felt, not_felt + 1e-6 * size, found),
        "")
        << i;
    if (found.empty()) {
      ++none;
    } else {
      ++(testing::deepest(found) > 0.0 ? clear : meeting);
    }
  }
  EXPECT_GT(none, 50);
  EXPECT_GT(clear, 10);
  EXPECT_GT(meeting, 100);
}

/// An edge by the places of its ends.
using EdgePlaces = std::array<double, 6>;

EdgePlaces placesOf(Vec3 from, Vec3 to) {
  if (std::tuple(to.x(), to.y(), to.z()) < std::tuple(from.x(), from.y(), from.z())) std::swap(from, to);
  return {from.x(), from.y(), from.z(), to.x(), to.y(), to.z()};
}

std::map<EdgePlaces, int> listedEdges(const MeshFeatures& features) {
  std::map<EdgePlaces, int> times;
  const TriangleMesh& mesh = features.tree().mesh();
  forEachChild(treeOf(features.tree()).arrays(), [&](Slot slot, Child child) {
    if (!child.isLeaf()) return;
    for (const SharpEdge& edge : features.edgesOf(features.of(slot))) {
      const Triangle triangle = mesh.triangle(features.triangleOf(edge));
      ++times[placesOf(triangle[edge.corner], triangle[(edge.corner + 1) % 3])];
    }
  });
  return times;
}

/// What an edge is by brute force.
struct KnownEdge {
  int triangles = 0;
  double turn = 0.0;  ///< the sine of the angle of its two triangles; less than 0: concave
};

std::map<EdgePlaces, KnownEdge> knownEdges(const TriangleMesh& mesh) {
  std::map<EdgePlaces, KnownEdge> edges;
  std::map<EdgePlaces, std::pair<Vec3, Vec3>> first;  // normal, and the corner across
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const Triangle triangle = mesh.triangle(t);
    const Vec3 normal = unitNormal(triangle);
    for (std::size_t v = 0; v < 3; ++v) {
      const EdgePlaces places = placesOf(triangle[v], triangle[(v + 1) % 3]);
      KnownEdge& edge = edges[places];
      if (++edge.triangles == 1) {
        first[places] = {normal, triangle[(v + 2) % 3]};
      } else {
        const double sine = normal.cross(first[places].first).norm();
        edge.turn = normal.dot(first[places].second - triangle[v]) < 0.0 ? sine : -sine;
      }
    }
  }
  return edges;
}

/// Each rim once, and each edge that is convex from some side; edges in a plane are none.
TEST(MeshFeatures, ofSheetsListRimsAndFolds) {
  std::mt19937_64 random(88);
  const Piece sheets[] = {
      Piece(waveSheet(2, 0.0, 6), Kind::sheet),
      Piece(waveSheet(2, 0.4, 9), Kind::sheet),
      Piece(waveSheet(2, 0.4, 9)),
      Piece(testing::torus(1.0, 0.3, 12, 8), Kind::sheet),
      Piece(testing::fan(3, 4), Kind::sheet),
      Piece(boxMesh({1, 2, 3}), Kind::sheet),
      Piece(testing::firstTriangles(*testing::bumpySphere(random, 1.0, 0.3, 12), 60), Kind::sheet)};
  int rims = 0, convex = 0, concave = 0, flat = 0;
  for (const Piece& sheet : sheets) {
    const auto listed = listedEdges(sheet.features);
    const auto known = knownEdges(sheet.mesh());
    for (const auto& [places, times] : listed) EXPECT_TRUE(known.contains(places));
    for (const auto& [places, edge] : known) {
      const auto found = listed.find(places);
      const int times = found == listed.end() ? 0 : found->second;
      ASSERT_LE(edge.triangles, 2);
      if (edge.triangles == 1 || std::abs(edge.turn) > 1e-9) {
        ASSERT_EQ(times, 1);
      } else {
        ASSERT_LE(times, 1);  // rounding decides
      }
      ++(edge.triangles == 1 ? rims : std::abs(edge.turn) < 1e-9 ? flat : edge.turn > 0.0 ? convex : concave);
    }
    for (std::uint32_t t = 0; t < sheet.mesh().triangleCount(); ++t) EXPECT_TRUE(sheet.features.isSheet(t));
  }
  EXPECT_EQ(listedEdges(sheets[0].features).size(), 4u * 6u);
  EXPECT_EQ(listedEdges(sheets[5].features).size(), 12u);
  EXPECT_GT(rims, 100);
  EXPECT_GT(convex, 300);
  EXPECT_GT(concave, 100);
  EXPECT_GT(flat, 50);
}

/// A solid lists its convex edges alone, whether a surface says that it is one or the caller.
TEST(MeshFeatures, ofSolidsListConvexEdgesAlone) {
  int convex = 0, concave = 0;
  for (const auto& mesh : {boxMesh({1, 2, 3}), testing::torus(1.0, 0.3, 12, 8), shapes::jack(1.0, 0.2)}) {
    const Piece of_surface(mesh), simple(mesh, Kind::simple);
    EXPECT_FALSE(of_surface.features.hasSheets());
    EXPECT_FALSE(simple.features.hasSheets());
    const auto listed = listedEdges(of_surface.features);
    EXPECT_EQ(listed, listedEdges(simple.features));
    for (const auto& [places, edge] : knownEdges(*mesh)) {
      const auto found = listed.find(places);
      if (std::abs(edge.turn) < 1e-9) continue;
      EXPECT_EQ(found == listed.end() ? 0 : found->second, edge.turn > 0.0 ? 1 : 0);
      ++(edge.turn > 0.0 ? convex : concave);
    }
  }
  EXPECT_GT(convex, 100);
  EXPECT_GT(concave, 50);
}

/// Triangles of one mesh may bound a solid or not.
TEST(MeshFeatures, ofASolidAndASheetInOneMeshListBoth) {
  const testing::SharedMesh box = boxMesh({1, 2, 3}),
                            sheet = testing::moved(*waveSheet(2, 0.0, 6), {Mat3::Identity(), Vec3(9, 0, 0)});
  const Piece both(testing::joined(*box, *sheet));
  EXPECT_TRUE(both.features.hasSheets());
  for (std::uint32_t t = 0; t < both.mesh().triangleCount(); ++t)
    EXPECT_EQ(both.features.isSheet(t), t >= box->triangleCount());
  auto expected = listedEdges(Piece(box).features);
  EXPECT_EQ(expected.size(), 12u);
  expected.merge(listedEdges(Piece(sheet, Kind::sheet).features));
  EXPECT_EQ(listedEdges(both.features), expected);
}

}  // namespace
}  // namespace octoblisk
