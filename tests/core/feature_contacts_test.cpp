// Contacts by features: closed forms, and brute force over all triangles.
#include "contact/feature_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/solid.h"
#include "octoblisk/closest_point.h"
#include "octoblisk/containment.h"
#include "octoblisk/distance.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"
#include "shared/solids.h"
#include "tree/tree.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::boxMesh;

struct Body {
  explicit Body(testing::SharedMesh shared) : solid(std::move(shared)), features(solid.tree) {}

  Solid solid;
  MeshFeatures features;
};

Pose at(const Vec3& position, const Vec3& rotation_vector = Vec3::Zero()) {
  const double angle = rotation_vector.norm();
  return {
      angle > 0.0 ? Mat3(Eigen::AngleAxisd(angle, rotation_vector / angle).matrix()) : Mat3(Mat3::Identity()),
      position};
}

/// Expects that the search finds the contacts.
std::vector<Contact> contactsOf(const Body& a, const Body& b, const Pose& b_in_a, double reach) {
  FeatureContacts contacts;
  std::vector<Contact> found;
  EXPECT_TRUE(contacts.find(a.features, b.features, b_in_a, reach, reach, found));
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
    if (!contacts.find(a.features, b.features, pose, 0.05, 0.05, found)) continue;
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

bool isVertex(const TriangleMesh& mesh, const Vec3& point) {
  return std::ranges::any_of(mesh.vertices(), [&](const Vec3& v) { return (v - point).norm() < 1e-12; });
}

/// Points, normals and distances of contacts, the depth of each corner, and the least distance.
TEST(FeatureContacts, ofRandomBodies_vs_bruteForce) {
  std::mt19937_64 random(65);
  const Body bodies[] = {Body(testing::bumpySphere(random, 1.0, 0.25, 20)),
                         Body(testing::torus(1.0, 0.4, 24, 16)), Body(boxMesh({0.8, 0.7, 0.9})),
                         Body(testing::bumpySphere(random, 1.0, 0.0, 12))};
  constexpr double kReach = 0.1, kSpacing = 0.1;
  int apart = 0, touching = 0, deep = 0, beyond = 0;
  std::size_t inside = 0, crossings = 0;
  FeatureContacts contacts;
  std::vector<Contact> found;
  for (int i = 0; i < 400; ++i) {
    const Body &a = bodies[i % 4], &b = bodies[i / 4 % 4];
    Pose pose = testing::randomPose(random, 0.0);
    pose.translation = 4.0 * testing::randomRotation(random).col(0);
    const Clearance start = distance(a.solid.tree, b.solid.tree, pose);
    pose.translation += (1.0 - testing::uniform(random, -0.12, 0.12) / start.distance) *
                        (start.point_on_a - start.point_on_b);
    const bool is_found = contacts.find(a.features, b.features, pose, kReach, kSpacing, found);
    const double exact = testing::bruteForceDistance(*a.solid.mesh, *b.solid.mesh, pose);
    const bool meet = !testing::bruteForcePairs(*a.solid.mesh, *b.solid.mesh, pose).empty();
    if (!is_found) {
      EXPECT_TRUE(meet) << i;
      ++deep;
      continue;
    }
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
      if (contact.distance >= -1e-9) continue;
      const bool of_a = isVertex(*a.solid.mesh, contact.point_on_a);
      const Vec3 corner = of_a ? pose.inverse() * contact.point_on_a : contact.point_on_b;
      if (!of_a && !isVertex(*b.solid.mesh, pose.inverse() * contact.point_on_b)) continue;  // of edges
      const Body& other = of_a ? b : a;
      ++inside;
      ASSERT_EQ(locate(other.solid.surface, corner), PointLocation::inside) << i;
      ASSERT_NEAR(closestPoint(other.solid.tree, corner)->distance, -contact.distance,
                  0.01 * -contact.distance + 1e-9);
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
  EXPECT_GT(deep, 20);
  EXPECT_GT(beyond, 10);
  EXPECT_GT(inside, 50u);
  EXPECT_LT(crossings, 20u);
}

}  // namespace
}  // namespace octoblisk
