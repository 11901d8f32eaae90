// Contacts by features: closed forms, and brute force over all triangles.
#include "contact/feature_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "contact/inside_corners.h"
#include "core/solid.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/collide.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"
#include "shared/block.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::boxMesh;

struct Body {
  explicit Body(testing::SharedMesh shared) : solid(std::move(shared)), features(SolidMesh(solid.surface)) {}

  Solid solid;
  MeshFeatures features;
};

Pose at(const Vec3& position, const Vec3& rotation_vector = Vec3::Zero()) {
  const double angle = rotation_vector.norm();
  return {
      angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, rotation_vector / angle).matrix()) : Mat3(Mat3::Identity()),
      position};
}

std::vector<Contact> contactsOf(const Body& a, const Body& b, const Pose& b_in_a, double reach = 1e-2) {
  std::vector<Contact> found;
  FeatureContacts().find(a.features, b.features, b_in_a, {}, reach, reach, found);
  return found;
}

TEST(MeshFeatures, listsEachCornerAndEachConvexEdgeOnce) {
  for (const auto& mesh : {boxMesh({1, 2, 3}), shapes::jack(1.0, 0.2), testing::torus(1.0, 0.3, 24, 12)}) {
    const Body body(mesh);
    const std::size_t count = mesh->triangleCount();
    std::size_t corners = 0;
    for (std::uint32_t place = 0; place < count; ++place)
      corners += static_cast<std::size_t>(std::popcount(body.features.cornersAt(place)));
    EXPECT_EQ(corners, body.solid.surface.cornerCount());
    constexpr float kSharp = 1e-3f;
    std::ptrdiff_t sharp = 0;
    forEachChild(treeOf(body.solid.tree).arrays(), [&](Slot slot, Child child) {
      if (!child.isLeaf()) return;
      const auto edges = body.features.edgesOf(body.features.of(slot));
      sharp += std::ranges::count_if(edges, [](const SharpEdge& e) { return e.sharpness > kSharp; });
    });
    std::ptrdiff_t convex = 0;
    for (std::uint32_t t = 0; t < count; ++t) {
      for (std::uint32_t u = t + 1; u < count; ++u) {
        const Triangle first = mesh->triangle(t), second = mesh->triangle(u);
        std::vector<Vec3> shared, others;
        for (const Vec3& p : second)
          (std::ranges::find(first, p) != first.end() ? shared : others).push_back(p);
        if (shared.size() != 2) continue;
        const Vec3 normal = unitNormal(first);
        const double angle = std::acos(std::clamp(normal.dot(unitNormal(second)), -1.0, 1.0));
        convex +=
            normal.dot(others[0] - first[0]) < 0.0 && (shared[1] - shared[0]).norm() * angle / 8.0 > kSharp;
      }
    }
    EXPECT_EQ(sharp, convex);
  }
}

TEST(FeatureContacts, ofABoxThatLiesTiltedByAHairAreItsFourCorners) {
  const Body floor(boxMesh({5, 5, 1})), box(boxMesh({0.5, 0.5, 0.5}));
  for (const double tilt : {0.0, 1e-9, 1e-5, 1e-3}) {
    const auto found = contactsOf(floor, box, at({0.3, 0.2, 1.5}, {tilt, -2.0 * tilt, 0.4}), 0.02);
    std::size_t corners = 0;
    for (const Contact& contact : found) {
      EXPECT_LT((contact.normal + Vec3::UnitZ()).norm(), 1e-12);
      corners += std::abs(contact.point_on_b.z() - contact.distance - 1.0) < 1e-12;
    }
    EXPECT_EQ(corners, 4u) << tilt;
    EXPECT_EQ(found.size(), 4u) << tilt;
  }
}

TEST(FeatureContacts, ofAPoseThatIsNotFiniteAreNone) {
  const Body torus(testing::torus(1.0, 0.3, 96, 48));
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(contactsOf(torus, torus, at({bad, 0.0, 0.0}), 0.02).empty());
}

TEST(FeatureContacts, ofCrossingEdgesPushAlongTheirPerpendicular) {
  const Body a(boxMesh({1, 1, 1})), b(boxMesh({1, 1, 1}));
  const Vec3 out = Vec3(1.0, 0.0, 1.0).normalized();  // over A's edge along y
  for (const double depth : {-0.01, 0.005}) {
    const auto found =
        contactsOf(a, b, at((2.0 * std::sqrt(2.0) - depth) * out, 0.5 * std::numbers::pi * out), 0.05);
    ASSERT_EQ(found.size(), 1u) << depth;
    EXPECT_NEAR(found[0].distance, -depth, 1e-12);
    EXPECT_LT((found[0].normal + out).norm(), 1e-12);
  }
}

TEST(FeatureContacts, ofCrossingBarsAreTheFourCornersOfTheirOverlap) {
  const Body a(boxMesh({2, 0.1, 0.1})), b(boxMesh({0.1, 2, 0.1}));
  for (const double depth : {-0.004, 0.004}) {
    const auto found = contactsOf(a, b, at({0.03, -0.02, 0.2 - depth}), 0.02);
    ASSERT_EQ(found.size(), 4u);
    for (const Contact& contact : found) {
      EXPECT_NEAR(contact.distance, -depth, 1e-12);
      EXPECT_LT((contact.normal + Vec3::UnitZ()).norm(), 1e-12);
      EXPECT_NEAR(std::abs(contact.point_on_a.x() - 0.03), 0.1, 1e-12);
      EXPECT_NEAR(std::abs(contact.point_on_a.y()), 0.1, 1e-12);
    }
  }
}

/// Their edges are acute: a direction between the normals of two faces may lead past the edge.
TEST(FeatureContacts, ofTetrahedraThatAreApartDoNotOverlap) {
  std::mt19937_64 random(66);
  int apart = 0, meet = 0;
  FeatureContacts contacts;
  std::vector<Contact> found;
  for (int i = 0; i < 400; ++i) {
    const auto tetrahedron = [&] {
      std::vector<Vec3> corners;
      for (int k = 0; k < 4; ++k) corners.push_back(testing::randomPoint(random, 1.0));
      const double volume =
          (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]);
      if (volume < 0.0) std::swap(corners[0], corners[1]);
      return std::make_shared<const TriangleMesh>(
          std::move(corners), std::vector<TriangleMesh::Indices>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    };
    const Body a(tetrahedron()), b(tetrahedron());
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = 5.0 * testing::randomRotation(random).col(0);
    const Clearance start = distance(a.solid.tree, b.solid.tree, pose);
    pose.translation += (1.0 - testing::uniform(random, -0.01, 0.02) / start.distance) *
                        (start.point_on_a - start.point_on_b);
    contacts.find(a.features, b.features, pose, {}, 0.05, 0.05, found);
    const bool do_meet = !testing::bruteForcePairs(*a.solid.mesh, *b.solid.mesh, pose).empty();
    ++(do_meet ? meet : apart);
    if (do_meet) continue;
    for (const Contact& contact : found) ASSERT_GE(contact.distance, -0.05 / 40.0) << i;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(meet, 20);
}

/// A bar lies on one box, and reaches into another box deeper than its contacts can say.
TEST(FeatureContacts, ofOnePlaceDoNotHideThatAnotherIsDeep) {
  const auto place = [](double x, double z) {
    return testing::moved(*boxMesh({0.1, 0.5, 0.5}), at({x, 0.0, z - 0.5}));
  };
  const Body bar(boxMesh({2, 0.1, 0.1}));
  constexpr double kReach = 0.02;
  for (const double depth : {0.0, 0.06}) {
    const Body supports(testing::joined(*place(-1.0, 0.0), *place(1.0, depth)));
    const auto found = contactsOf(supports, bar, at({0.0, 0.0, 0.099}), kReach);
    const auto deep = std::ranges::count_if(found, [&](const Contact& contact) {
      return contact.distance < -kReach && std::abs(contact.point_on_a.x() - 1.0) < 0.2;
    });
    EXPECT_EQ(deep, depth == 0.0 ? 0 : 1);
    for (const Contact& contact : found) {
      if (contact.distance > -kReach) continue;
      EXPECT_NEAR(contact.distance, -0.061, 1e-9);
      EXPECT_LT((contact.normal + Vec3::UnitZ()).norm(), 1e-9);
    }
  }
}

/// The number of corners of `body` that are `depth` deep under the top of `floor`.
std::ptrdiff_t cornersUnderTop(const Body& floor, const Body& body, const Pose& body_in_floor, double depth) {
  return std::ranges::count_if(contactsOf(floor, body, body_in_floor), [&](const Contact& contact) {
    return std::abs(contact.distance + depth) < 1e-9 && (contact.normal + Vec3::UnitZ()).norm() < 1e-9;
  });
}

/// Near the rim, corners are nearer to the sides of the box below, which cannot push them, than to its top.
TEST(FeatureContacts, ofABoxNearTheRimOfAnotherAreItsFourCorners) {
  constexpr double kDepth = 1e-3;
  const Body floor(boxMesh({1, 1, 1}));
  for (const double inset : {1e-12, 1e-6, 0.9 * kDepth, 0.02}) {
    const Body box(boxMesh({1.0 - inset, 1.0 - inset, 1}));
    EXPECT_EQ(cornersUnderTop(floor, box, at({0, 0, 2.0 - kDepth}), kDepth), 4) << inset;
  }
}

/// Past the middle of a plate, the nearest face cannot push a peg. A face of another plate is over its end.
TEST(FeatureContacts, aPegPastTheMiddleOfAPlateIsPushedBack) {
  constexpr double kHalfThickness = 0.02, kDepth = 0.025;
  const auto upper = boxMesh({1, 1, kHalfThickness});
  const auto lower = testing::moved(*upper, at({0, 0, -2.0 * kHalfThickness - 0.002}));
  const Body peg(boxMesh({0.1, 0.1, 0.5}));
  const Pose pose = at({0.03, 0.02, kHalfThickness - kDepth + 0.5});
  EXPECT_EQ(cornersUnderTop(Body(upper), peg, pose, kDepth), 4);
  EXPECT_EQ(cornersUnderTop(Body(testing::joined(*upper, *lower)), peg, pose, kDepth), 4);
}

std::optional<std::uint32_t> cornerAt(const Body& body, const Vec3& point) {
  for (std::uint32_t corner = 0; corner < body.features.cornerCount(); ++corner) {
    if ((body.features.position(corner) - point).norm() < 1e-12) return corner;
  }
  return std::nullopt;
}

/// Points, normals and distances of contacts, the depth of each corner, and the least distance.
TEST(FeatureContacts, ofRandomBodies_vs_bruteForce) {
  std::mt19937_64 random(65);
  const Body bodies[] = {Body(testing::bumpySphere(random, 1.0, 0.25, 20)),
                         Body(testing::torus(1.0, 0.4, 24, 16)), Body(boxMesh({0.8, 0.7, 0.9})),
                         Body(testing::bumpySphere(random, 1.0, 0.0, 12))};
  constexpr double kReach = 0.1, kSpacing = 0.1;
  int apart = 0, touching = 0, beyond = 0;
  std::size_t inside = 0, deep = 0, farther = 0, crossings = 0;
  FeatureContacts contacts;
  std::vector<Contact> found;
  for (int i = 0; i < 400; ++i) {
    const Body &a = bodies[i % 4], &b = bodies[i / 4 % 4];
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = 4.0 * testing::randomRotation(random).col(0);
    const Clearance start = distance(a.solid.tree, b.solid.tree, pose);
    pose.translation += (1.0 - testing::uniform(random, -0.12, 0.12) / start.distance) *
                        (start.point_on_a - start.point_on_b);
    contacts.find(a.features, b.features, pose, {}, kReach, kSpacing, found);
    const double exact = testing::bruteForceDistance(*a.solid.mesh, *b.solid.mesh, pose);
    const bool meet = !testing::bruteForcePairs(*a.solid.mesh, *b.solid.mesh, pose).empty();
    double least = std::numeric_limits<double>::infinity();
    for (const Contact& contact : found) {
      least = std::min(least, contact.distance);
      ASSERT_NEAR(contact.normal.norm(), 1.0, 1e-9);
      ASSERT_LT((contact.point_on_a - contact.point_on_b - contact.distance * contact.normal).norm(), 1e-9);
      const double off_a = closestPoint(a.solid.tree, contact.point_on_a)->distance,
                   off_b = closestPoint(b.solid.tree, pose.inverse() * contact.point_on_b)->distance;
      if (std::max(off_a, off_b) > 1e-9 + 2.0 * kAlike * std::abs(contact.distance)) {
        ASSERT_TRUE(meet) << i;
        ++crossings;  // the middle of a curve is on no surface
        continue;
      }
      if (contact.distance >= -kSpacing / 40.0) continue;
      const auto corner_of_a = cornerAt(a, contact.point_on_a),
                 corner_of_b = cornerAt(b, pose.inverse() * contact.point_on_b);
      const bool of_a = corner_of_a.has_value();
      if (!of_a && !corner_of_b) continue;  // of edges
      const Vec3 corner = of_a ? pose.inverse() * contact.point_on_a : contact.point_on_b;
      const Body& other = of_a ? b : a;
      ++inside;
      ASSERT_EQ(locate(other.solid.surface, corner), PointLocation::inside) << i;
      const ClosestPoint out = *closestPoint(other.solid.tree, corner);
      deep += out.distance > kReach;
      const Vec3 to_nearest = (out.point - corner).normalized();
      const bool is_pushed =
          of_a ? a.features.isPushedAlong(*corner_of_a, pose.rotation * to_nearest)
               : b.features.isPushedAlong(*corner_of_b, pose.rotation.transpose() * to_nearest);
      if (is_pushed) {
        ASSERT_NEAR(-contact.distance, out.distance, 1e-9) << i;
      } else {
        ++farther;
        ASSERT_GT(-contact.distance, out.distance) << i;
      }
    }
    if (meet) {
      ++touching;
      ASSERT_LT(least, kSpacing / 40.0) << i;
    } else if (exact <= kReach) {
      ++apart;
      ASSERT_NEAR(least, exact, kSpacing / 40.0) << i;
    } else {
      ++beyond;
      ASSERT_TRUE(found.empty()) << i;
    }
  }
  EXPECT_GT(apart, 10);
  EXPECT_GT(touching, 10);
  EXPECT_GT(beyond, 10);
  EXPECT_GT(inside, 50u);
  EXPECT_GT(deep, 5u);
  EXPECT_GT(farther, 5u);
  EXPECT_LT(farther, inside / 5);
  EXPECT_LT(crossings, inside);
}

bool pushAlong(const std::vector<Contact>& contacts, const Vec3& direction, double least_cosine) {
  return std::ranges::any_of(contacts, [&](const Contact& c) {
    return c.distance <= 0.0 && c.normal.dot(direction) > least_cosine;
  });
}

testing::SharedMesh blockOf(const Vec3& half_extents, int steps) {
  return std::make_shared<const TriangleMesh>(testing::block(half_extents, steps));
}

/// A cup that sits in an equal cup leaves it if it rises by five times the overlap of the walls.
TEST(FeatureContacts, nestedCupsAreNotPushedFartherThanTheyOverlap) {
  constexpr double kWall = 0.008, kSlope = 0.2, kFacets = 0.0022;  // the rise that turned facets add
  const Body cup(testing::cup(0.03, 0.05, 0.1, kWall, 24));
  std::mt19937_64 random(108);
  int overlap = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const double lowered = testing::uniform(random, -0.002, 0.004),
                 aside = testing::uniform(random, 0.0, 0.002);
    const Pose pose{Eigen::AngleAxisd(testing::uniform(random, 0.0, 6.0), Vec3::UnitZ()).toRotationMatrix(),
                    Vec3(aside, 0.0, kWall / kSlope - lowered)};
    const std::vector<Contact> contacts = contactsOf(cup, cup, pose);
    if (contacts.empty()) continue;
    const double deepest = testing::deepest(contacts);
    overlap += deepest < -1e-4;
    EXPECT_GT(deepest, -(std::max(0.0, lowered + aside / kSlope) + kFacets)) << i;
  }
  EXPECT_GT(overlap, kCases / 2);
}

/// The overlap is several triangles deep, so the triangles at the sides are as deep as those at the top.
TEST(FeatureContacts, barsThatCrossAreNotPinched) {
  const Body bar(blockOf({0.5, 0.08, 0.08}, 12));
  std::mt19937_64 random(102);
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const Pose pose{
        Eigen::AngleAxisd(testing::uniform(random, 1.0, 2.1), Vec3::UnitY()).toRotationMatrix() *
            Eigen::AngleAxisd(testing::uniform(random, -0.1, 0.1), Vec3::UnitX()).toRotationMatrix(),
        Vec3{testing::uniform(random, -0.2, 0.2), testing::uniform(random, 0.07, 0.14),
             testing::uniform(random, -0.2, 0.2)}};
    const std::vector<Contact> contacts = contactsOf(bar, bar, pose);
    const auto isPinched = [&](const std::vector<Contact>& all) {
      return std::ranges::any_of(all, [&](const Contact& c) {
        return c.distance <= 0.0 && std::abs(c.normal.y()) < 0.2 && pushAlong(all, -c.normal, 0.9);
      });
    };
    ASSERT_FALSE(isPinched(contacts)) << i;
    ASSERT_TRUE(pushAlong(contacts, -Vec3::UnitY(), 0.7)) << i;
    double depth = 0.0;
    for (const Contact& contact : contacts) {
      if (-contact.normal.y() > 0.9) depth = std::max(depth, -contact.distance);
    }
    EXPECT_NEAR(depth, 0.16 - pose.translation.y(), 0.03) << i;  // the bars are tilted
  }
}

/// A bar crosses two others at different heights. The curve as a whole extends farther than the bar is deep.
TEST(FeatureContacts, eachCrossingHasItsOwnDepth) {
  constexpr double kTilt = 0.4, kApart = 0.35, kOverlap = 0.06;
  const Body bar(blockOf({0.5, 0.08, 0.08}, 12));
  const Pose tilted{Eigen::AngleAxisd(kTilt, Vec3::UnitY()).toRotationMatrix(), Vec3::Zero()};
  const auto crossing = [&](double x) {
    return testing::moved(testing::block({0.08, 0.5, 0.08}, 12),
                          tilted * Pose{Mat3::Identity(), Vec3(x, 0.0, kOverlap - 0.16)});
  };
  const Body two(testing::joined(*crossing(-kApart), *crossing(kApart)));
  // Upright would be parallel faces; turn about the bar's axis.
  const Pose turned{Eigen::AngleAxisd(0.03, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero()};
  const std::vector<Contact> contacts = contactsOf(two, bar, tilted * turned);
  const Vec3 up = tilted.rotation.col(2);
  for (const double side : {-1.0, 1.0}) {
    double depth = 0.0;
    for (const Contact& contact : contacts) {
      const bool is_here = side * tilted.rotation.col(0).dot(contact.point_on_a) > 0.0;
      if (is_here && contact.normal.dot(-up) > 0.9) depth = std::max(depth, -contact.distance);
    }
    EXPECT_NEAR(depth, kOverlap, 0.01) << side;
  }
}

/// One bar crosses another from above, and a third from the side.
TEST(FeatureContacts, eachCrossingHasItsOwnWayOut) {
  constexpr double kOverlap = 0.06;
  const auto barAt = [](const Vec3& half, const Vec3& place) {
    return testing::moved(testing::block(half, 12), {Mat3::Identity(), place});
  };
  const Mat3 askew = Eigen::AngleAxisd(0.03, Vec3(1, 0.4, 0.2).normalized()).toRotationMatrix();
  const Body bar(barAt({1.0, 0.08, 0.08}, Vec3::Zero()));
  const Body two(testing::joined(*barAt({0.08, 0.5, 0.08}, {-0.6, 0, 0.16 - kOverlap}),
                                 *barAt({0.08, 0.08, 0.5}, {0.6, 0.16 - kOverlap, 0})));
  const std::vector<Contact> contacts = contactsOf(bar, two, {askew, Vec3::Zero()});
  for (const Contact& contact : contacts) EXPECT_GT(contact.distance, -1.7 * kOverlap);
  for (const auto& side_and_out : {std::pair(-1.0, Vec3(0, 0, -1)), std::pair(1.0, Vec3(0, -1, 0))}) {
    const double side = side_and_out.first;
    const Vec3& out = side_and_out.second;
    const auto pushesOut = [&](const Contact& contact) {
      return side * contact.point_on_a.x() > 0.3 && contact.normal.dot(out) > 0.95;
    };
    EXPECT_TRUE(std::ranges::any_of(contacts, pushesOut)) << side;
  }
}

/// More than halfway in a floor, the upper side of a thin body is as near to the floor's triangles as its
/// lower side. It must not pull the body down.
TEST(FeatureContacts, aFloorDoesNotPullThinBodiesDown) {
  const auto pulls = [](const Contact& contact) {
    return contact.distance <= 0.0 && contact.normal.z() > 0.3;
  };
  const Body floor(shapes::solidBelow(*testing::waveSheet(1.0, 0.0, 16), -1.0));
  const Body bar(blockOf({0.5, 0.03, 0.02}, 4)), ring(testing::torus(0.4, 0.05, 24, 8));
  std::mt19937_64 random(109);
  int pushed = 0;
  constexpr int kCases = 600;
  for (int i = 0; i < kCases; ++i) {
    const Pose pose{testing::randomRotation(random), Vec3(0.1, 0.05, testing::uniform(random, -0.2, 0.0))};
    const Body& body = i % 2 == 0 ? bar : ring;
    const std::vector<Contact> kept = contactsOf(floor, body, pose);
    EXPECT_FALSE(std::ranges::any_of(kept, pulls)) << i;
    pushed += pushAlong(kept, -Vec3::UnitZ(), 0.9);
  }
  EXPECT_GT(pushed, kCases / 3);
}

/// A body in a corner, and one that touches both walls of a channel, are held by faces that face each other.
TEST(FeatureContacts, wallsAreNoPinch) {
  constexpr double kDepth = 1e-3;
  const Body room(testing::joined(
      *testing::moved(testing::block({2, 2, 0.5}, 9), {Mat3::Identity(), Vec3(0, 0, -0.5)}),
      *testing::joined(
          *testing::moved(testing::block({2, 0.5, 2}, 9), {Mat3::Identity(), Vec3(0, -0.5, 1)}),
          *testing::moved(testing::block({0.5, 2, 2}, 9), {Mat3::Identity(), Vec3(-0.5, 0, 1)}))));
  const Body box(blockOf({0.15, 0.15, 0.5}, 4));
  const std::vector<Contact> in_corner =
      contactsOf(box, room, {Mat3::Identity(), Vec3(kDepth - 0.15, kDepth - 0.15, kDepth - 0.5)});
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(pushAlong(in_corner, Vec3::Unit(k), 0.9)) << k;

  const double yaw = 0.02, half_width = 0.5 * std::sin(yaw) + 0.1 * std::cos(yaw) - kDepth;
  const auto wallAt = [&](double y) {
    return testing::moved(testing::block({2, 0.5, 2}, 9), {Mat3::Identity(), Vec3(0, y, 1)});
  };
  const Body channel(
      testing::joined(*testing::moved(testing::block({2, 2, 0.5}, 9), {Mat3::Identity(), Vec3(0, 0, -0.5)}),
                      *testing::joined(*wallAt(-0.5 - half_width), *wallAt(0.5 + half_width))));
  const Pose yawed{Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), Vec3(0, 0, 0.1 - kDepth)};
  const std::vector<Contact> in_channel =
      contactsOf(Body(blockOf({0.5, 0.1, 0.1}, 4)), channel, yawed.inverse());
  for (const double side : {-1.0, 1.0}) {
    const Vec3 in_box = side * yawed.rotation.row(1).transpose();
    EXPECT_TRUE(pushAlong(in_channel, in_box, 0.9)) << side;
  }
  EXPECT_TRUE(pushAlong(in_channel, Vec3::UnitZ(), 0.9));
}

/// Faces, edges and corners coincide, so that no corner is inside, and all edges that cross are parallel to
/// faces.
TEST(FeatureContacts, ofAlignedBodiesAreFound) {
  for (const auto& mesh : {boxMesh({1, 1, 1}), testing::torus(1.0, 0.4, 24, 16)}) {
    const Body body(mesh);
    for (const double shift : {0.0, 1e-9, 1e-3, 0.01, 0.1, 0.5}) {
      for (const Vec3& along : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 1, 1)}) {
        const auto found = contactsOf(body, body, at(shift * along));
        const auto touches = [](const Contact& c) { return c.distance <= 0.0 && c.normal.norm() > 0.99; };
        EXPECT_TRUE(std::ranges::any_of(found, touches)) << shift << ' ' << along.transpose();
      }
    }
  }
}

/// Walks from corner to corner find those that `locate` finds one by one. Half the poses are so deep that
/// most of them are on no triangle that meets the other surface.
TEST(InsideCorners, ofRandomBodies_vs_locate) {
  std::mt19937_64 random(67);
  const Body bodies[] = {Body(testing::bumpySphere(random, 1.0, 0.25, 20)),
                         Body(testing::torus(1.0, 0.4, 24, 16)), Body(boxMesh({0.8, 0.7, 0.9}))};
  InsideCorners inside;
  std::size_t found = 0, outside = 0, walked = 0;
  for (int i = 0; i < 300; ++i) {
    const Body &a = bodies[i % 3], &b = bodies[i / 3 % 3];
    const Pose pose = testing::randomPose(random, i % 2 == 0 ? 0.8 : 1.6);
    std::vector<std::uint32_t> seeds;
    std::vector<TrianglePair> meeting;
    touchingPairs(a.solid.tree, b.solid.tree, pose, meeting);
    for (const TrianglePair& pair : meeting) {
      for (const std::uint32_t corner : b.features.cornersOf(pair.b)) seeds.push_back(corner);
    }
    if (seeds.empty()) continue;
    inside.find(b.features, pose, a.features.solid(), Pose(), seeds);
    for (std::uint32_t corner = 0; corner < b.features.cornerCount(); ++corner) {
      const bool is_inside =
          locate(a.solid.surface, pose * b.features.position(corner)) == PointLocation::inside;
      ASSERT_EQ(inside.contains(corner), is_inside) << i << ' ' << corner;
      ++(is_inside ? found : outside);
      walked += is_inside && std::ranges::find(seeds, corner) == seeds.end();
    }
  }
  EXPECT_GT(found, 5000u);
  EXPECT_GT(outside, 5000u);
  EXPECT_GT(walked, found / 4);
}

}  // namespace
}  // namespace octoblisk
