// Tests which triangles of a mesh with holes, doubled facets or overlaps bound a solid, and where points are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "contact/solid_mesh.h"
#include "core/solid.h"
#include "octoblisk/containment.h"
#include "octoblisk/depth.h"
#include "octoblisk/mass_properties.h"
#include "query/solid_parts.h"
#include "shared/brute_force.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

/// Returns the mesh without some triangles.
SharedMesh without(const TriangleMesh& mesh, const auto& is_left_out) {
  std::vector<TriangleMesh::Indices> kept;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    if (!is_left_out(mesh.triangle(t))) kept.push_back(mesh.triangles()[t]);
  }
  return std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(kept));
}

/// A sphere with bumps. `holed` cuts a hole around its top.
SharedMesh bumpy() {
  std::mt19937_64 random(5);
  return testing::bumpySphere(random, 1.0, 0.3, 24);
}
SharedMesh holed(const TriangleMesh& mesh) {
  return without(mesh, [](const Triangle& triangle) { return centroidOf(triangle).normalized().z() > 0.96; });
}

std::size_t countOf(const Surface& surface, TriangleRole role) {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < surface.tree().mesh().triangleCount(); ++t) count += surface.role(t) == role;
  return count;
}

/// The roles that occur at points of a triangle, by winding numbers just before and behind it.
std::vector<TriangleRole> rolesOn(const TriangleMesh& mesh, const Triangle& triangle) {
  std::vector<TriangleRole> roles;
  constexpr int kSteps = 12;
  for (int i = 1; i < kSteps; ++i) {
    for (int j = 1; i + j < kSteps; ++j) {
      const Vec3 point = triangle[0] + (triangle[1] - triangle[0]) * (i + 0.1) / kSteps +
                         (triangle[2] - triangle[0]) * (j + 0.13) / kSteps;
      const auto isInside = [&](double height) {
        return std::abs(testing::windingNumber(mesh, point + height * unitNormal(triangle))) > 0.5;
      };
      const bool before = isInside(1e-9), behind = isInside(-1e-9);
      roles.push_back(before ? (behind ? TriangleRole::inner : TriangleRole::inward)
                             : (behind ? TriangleRole::outward : TriangleRole::sheet));
    }
  }
  return roles;
}

TEST(SolidRoles, isWholeWithoutDefects) {
  for (const SharedMesh& mesh :
       {bumpy(), testing::torus(1.0, 0.3, 16, 8), testing::boxMesh({1, 2, 3}),
        testing::boxMesh({1e-9, 2e-9, 3e-9}), testing::insideOut(*testing::torus(1.0, 0.3, 16, 8)),
        testing::joined(*testing::boxMesh({1, 1, 1}), *testing::torus(5, 1, 12, 8)),
        testing::joined(*testing::boxMesh({2, 2, 2}), *testing::insideOut(*testing::boxMesh({1, 1, 1})))}) {
    const Solid solid(mesh);
    EXPECT_TRUE(solid.surface.isWhole());
    EXPECT_TRUE(solid.surface.isClosed());
    EXPECT_EQ(&solid.surface.boundary(), &solid.surface.tree());
  }
}

TEST(SolidRoles, overlaps_vs_windingNumbers) {
  const SharedMesh ring = testing::torus(1.0, 0.35, 18, 10);
  const SharedMesh beside = testing::moved(*ring, {Mat3::Identity(), Vec3(1.1, 0.1, 0.05)});
  const SharedMesh meshes[] = {
      testing::joined(*ring, *beside),                        // overlapping
      testing::joined(*ring, *testing::insideOut(*beside)),   // the overlap is outside
      testing::joined(*testing::boxMesh({2, 2, 1}), *ring)};  // one in the other
  for (const SharedMesh& mesh : meshes) {
    const Solid solid(mesh);
    EXPECT_TRUE(solid.surface.isClosed());
    EXPECT_FALSE(solid.surface.isWhole());
    EXPECT_TRUE(solid.surface.isOriented());
    const Surface& boundary = detail::boundaryOf(solid.surface);
    std::vector<double> bounding(mesh->triangleCount(), 0.0);  // the area that is part of the boundary
    for (std::uint32_t t = 0; t < boundary.tree().mesh().triangleCount(); ++t)
      bounding[solid.surface.sourceOf(t)] += scaledNormal(boundary.tree().mesh().triangle(t)).norm();
    std::map<TriangleRole, int> count;
    int mixed = 0;
    double greatest_error = 0.0, sum_of_errors = 0.0;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      const std::vector<TriangleRole> sampled = rolesOn(*mesh, mesh->triangle(t));
      const TriangleRole role = solid.surface.role(t);
      ++count[role];
      const auto share = [&](TriangleRole of) {
        return static_cast<double>(std::ranges::count(sampled, of)) / static_cast<double>(sampled.size());
      };
      const double area = bounding[t] / scaledNormal(mesh->triangle(t)).norm();
      const double error = area - (1.0 - share(TriangleRole::inner));
      greatest_error = std::max(greatest_error, std::abs(error));
      sum_of_errors += error;
      // A triangle that others cut is inner only if all of it is. It has the role of most of the rest.
      ASSERT_EQ(role == TriangleRole::inner, area == 0.0) << t;
      ASSERT_TRUE(share(role) > 0.0 || area < 0.05) << t;
      if (share(role) == 1.0) continue;
      ++mixed;
      ASSERT_TRUE(std::ranges::binary_search(solid.surface.solidParts().intersecting, t)) << t;
    }
    EXPECT_LT(greatest_error, 0.15);
    EXPECT_LT(std::abs(sum_of_errors), 0.01 * static_cast<double>(mesh->triangleCount()));
    EXPECT_GT(count[TriangleRole::outward], 10);
    EXPECT_EQ(count[TriangleRole::sheet], 0);
    EXPECT_GT(count[TriangleRole::inner] + count[TriangleRole::inward], 10);
    if (mesh != meshes[2]) {
      EXPECT_GT(mixed, 10);
    }
    const Surface by_three(solid.tree, 3);
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t)
      ASSERT_EQ(by_three.role(t), solid.surface.role(t));
  }
}

TEST(SolidRoles, trianglesAroundAHoleAreSheets) {
  const Solid open(holed(*bumpy()));
  EXPECT_FALSE(open.surface.isClosed());
  EXPECT_FALSE(open.surface.isWhole());
  EXPECT_FALSE(open.surface.isOriented());
  int sheets = 0, at_the_hole = 0;
  for (std::uint32_t t = 0; t < open.mesh->triangleCount(); ++t) {
    const Triangle triangle = open.mesh->triangle(t);
    const TriangleRole role = open.surface.role(t);
    ASSERT_TRUE(role == TriangleRole::sheet || role == TriangleRole::outward);
    bool is_at_the_hole = false;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t from = open.surface.corners(t)[e], to = open.surface.corners(t)[(e + 1) % 3];
      const auto uses = std::ranges::count_if(open.surface.star(from), [&](std::uint32_t other) {
        return std::ranges::count(open.surface.corners(other), to) > 0;
      });
      is_at_the_hole |= uses == 1;
    }
    // The winding number behind it is 1 less the share of all directions in which it sees the hole.
    const double share =
        1.0 - testing::windingNumber(*open.mesh, centroidOf(triangle) - 1e-9 * unitNormal(triangle));
    ASSERT_EQ(role == TriangleRole::sheet, std::abs(share) > 1.0 / 4.0 || is_at_the_hole)
        << t << ' ' << share;
    // Bodies may get in through a hole that is seen in a smaller share.
    ASSERT_EQ(detail::SolidMesh(open.surface).boundsSolid(t),
              !(std::abs(share) > 1.0 / 64.0) && !is_at_the_hole)
        << t << ' ' << share;
    at_the_hole += is_at_the_hole;
    sheets += role == TriangleRole::sheet;
  }
  EXPECT_GT(at_the_hole, 10);
  EXPECT_GE(sheets, at_the_hole);
  EXPECT_LT(sheets, static_cast<int>(open.mesh->triangleCount()) / 2);
}

TEST(SolidRoles, doubledFacetsAreOneSolid) {
  const SharedMesh ring = testing::torus(1.0, 0.3, 16, 8), inward = testing::insideOut(*ring);
  const auto count = static_cast<std::uint32_t>(ring->triangleCount());
  for (const SharedMesh& mesh : {testing::joined(*ring, *ring), testing::joined(*inward, *inward)}) {
    const Solid solid(mesh);
    EXPECT_TRUE(solid.surface.isClosed());
    EXPECT_FALSE(solid.surface.isWhole());
    const bool is_outward = mesh->triangles()[0] == ring->triangles()[0];
    EXPECT_EQ(countOf(solid.surface, is_outward ? TriangleRole::outward : TriangleRole::inward), 2u * count);
    EXPECT_EQ(solid.surface.boundary().mesh().triangleCount(), count);
  }
  // A surface and the same surface turned around enclose nothing.
  const Solid both(testing::joined(*ring, *inward));
  EXPECT_FALSE(both.surface.isClosed());
  EXPECT_EQ(countOf(both.surface, TriangleRole::sheet), 2u * count);
}

TEST(SolidRoles, locate_vs_theClosedSurface) {
  const Solid closed(bumpy()), open(holed(*closed.mesh));
  std::mt19937_64 random(7);
  int inside = 0, compared = 0;
  constexpr int kPoints = 3000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 point = testing::randomPoint(random, 1.1);
    const PointLocation expected = locate(closed.surface, point), found = locate(open.surface, point);
    const ClosestPoint nearest = closestPoint(open.tree, point).value();
    ASSERT_EQ(locate(open.surface, point, nearest), found);
    ASSERT_EQ(locate(closed.surface, point, closestPoint(closed.tree, point).value()), expected);
    // Between the missing surface and the surface where the winding number is one half, they differ.
    if (point.z() > 0.6 && std::hypot(point.x(), point.y()) < 0.7) continue;
    ASSERT_EQ(found, expected) << point.transpose();
    ++compared;
    inside += expected == PointLocation::inside;
  }
  EXPECT_GT(compared, kPoints * 8 / 10);
  EXPECT_GT(inside, compared * 3 / 10);
  EXPECT_LT(inside, compared * 7 / 10);
}

TEST(SolidRoles, depthDoesNotDependOnAHoleElsewhere) {
  const Solid closed(bumpy()), open(holed(*closed.mesh)), tool(testing::boxMesh({0.2, 0.3, 0.25}));
  constexpr double kTolerance = 1e-4;
  std::mt19937_64 random(8);
  DepthQuery query;
  int touching = 0, at_the_hole = 0, apart = 0, wrong = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose pose{testing::randomRotation(random), testing::randomPoint(random, 1.3)};
    const GougeDepth expected = query.deepest(closed.surface, tool.surface, pose, kTolerance);
    const GougeDepth found = query.deepest(open.surface, tool.surface, pose, kTolerance);
    ASSERT_TRUE(expected.is_known);
    const bool is_far = pose.translation.z() < -0.2;
    if (is_far) {
      ASSERT_TRUE(found.is_known);
      ASSERT_EQ(found.gouging, expected.gouging);
    }
    if (!found.is_known) {
      ++at_the_hole;
      continue;
    }
    apart += expected.gouging == Gouging::none;
    if (expected.gouging == Gouging::none) continue;
    ++touching;
    // The distance to the remaining surface is at least that to the whole surface, so the depth is never
    // less.
    EXPECT_GE(found.upper_bound, expected.depth - 1e-12);
    if (is_far) {
      ASSERT_NEAR(found.depth, expected.depth, kTolerance);
    }
    wrong += std::abs(found.depth - expected.depth) > kTolerance;
  }
  EXPECT_GT(touching, 100);
  EXPECT_GT(apart, 30);
  EXPECT_GT(at_the_hole, 10);
  EXPECT_LT(wrong, touching / 20) << "deeper beside the hole";
}

TEST(SolidRoles, depthWhereTheSurfaceIsDoubledOrMeetsItself) {
  const SharedMesh ring = testing::torus(1.0, 0.35, 24, 12);
  const SharedMesh beside = testing::moved(*ring, {Mat3::Identity(), Vec3(1.1, 0.1, 0.05)});
  const Solid single(ring), doubled(testing::joined(*ring, *ring)),
      overlapping(testing::joined(*ring, *beside)), other(beside);
  const Solid tool(testing::boxMesh({0.05, 0.06, 0.07}));
  DepthQuery query;
  const auto depthIn = [&](const Solid& solid, const Vec3& place) {
    const GougeDepth found = query.deepest(solid.surface, tool.surface, {Mat3::Identity(), place}, 1e-5);
    EXPECT_TRUE(found.is_known);
    return found;
  };
  int in_both = 0, in_one = 0;
  std::mt19937_64 random(9);
  for (int i = 0; i < 300; ++i) {
    const Vec3 place = Vec3(0.55, 0.0, 0.0) + testing::randomPoint(random, 0.9);
    const GougeDepth of_ring = depthIn(single, place), of_doubled = depthIn(doubled, place);
    ASSERT_EQ(of_ring.gouging, of_doubled.gouging);
    ASSERT_NEAR(of_ring.depth, of_doubled.depth, 1e-5);
    const GougeDepth of_other = depthIn(other, place), of_overlapping = depthIn(overlapping, place);
    const bool meets_ring = of_ring.gouging == Gouging::found,
               meets_other = of_other.gouging == Gouging::found;
    ASSERT_EQ(of_overlapping.gouging == Gouging::found, meets_ring || meets_other);
    // Of the union, a point is at least as deep as of either ring.
    ASSERT_GE(of_overlapping.depth, std::max(of_ring.depth, of_other.depth) - 1e-5);
    in_both += meets_ring && meets_other;
    in_one += meets_ring != meets_other;
  }
  EXPECT_GT(in_both, 10);
  EXPECT_GT(in_one, 30);
}

TEST(SolidRoles, isNeitherAroundNorBelowWhatIsNowhere) {
  const SharedMesh mesh = bumpy();
  for (const SharedMesh& of_a : {mesh, holed(*mesh), testing::joined(*mesh, *mesh)}) {
    const Solid a(of_a), b(mesh);
    EXPECT_EQ(a.surface.isWhole(), of_a == mesh);
    for (const double far :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e30}) {
      const Pose pose{Mat3::Identity(), Vec3(far, 0, 0)};
      EXPECT_EQ(locate(a.surface, pose.translation), PointLocation::outside) << far;
      EXPECT_EQ(DepthQuery().deepest(a.surface, b.surface, pose, 1e-6).gouging, Gouging::none) << far;
      EXPECT_EQ(DepthQuery().deepest(b.surface, a.surface, pose, 1e-6).gouging, Gouging::none) << far;
    }
  }
}

SharedMesh boxBetween(const Vec3& low, const Vec3& high) {
  return testing::moved(*testing::boxMesh((high - low) / 2.0), {Mat3::Identity(), (high + low) / 2.0});
}

/// A point on a triangle inside the solid is inside, also if coordinates are equal to the last bit.
TEST(SolidRoles, innerTrianglesAreInside) {
  const Solid solid(
      testing::joined(*boxBetween({-1, -1, -1}, {1, 1, 1}), *boxBetween({0, -1.5, -1.5}, {3, 1.5, 1.5})));
  EXPECT_EQ(locate(solid.surface, Vec3(0, 0.1, 0.2)), PointLocation::inside);
  EXPECT_EQ(locate(solid.surface, Vec3(1, 0.1, 0.2)), PointLocation::inside);
  EXPECT_EQ(locate(solid.surface, Vec3(3, 0.1, 0.2)), PointLocation::on_surface);
  EXPECT_EQ(locate(solid.surface, Vec3(0, 1.2, 0.2)), PointLocation::on_surface);
  DepthQuery query;
  for (const double x : {-0.5, 0.0, 0.5, 1.0}) {
    const Solid small(boxBetween({x, -0.25, -0.25}, {x + 0.5, 0.25, 0.25}));
    EXPECT_EQ(containment(solid.surface, small.surface, {}), Containment::b_inside_a) << x;
    const GougeDepth found = query.deepest(solid.surface, small.surface, {}, 1e-7);
    EXPECT_EQ(found.gouging, Gouging::found) << x;
    EXPECT_GT(found.depth, 0.7) << x;
  }
}

/// A hole that another part covers in part is a hole.
TEST(SolidRoles, aHoleThatIsHalfCovered) {
  const SharedMesh open_box = without(*boxBetween({-2, -2, -2}, {2, 2, 2}), [](const Triangle& triangle) {
    return centroidOf(triangle).z() == 2.0;
  });
  for (const double side : {1.0, -1.0}) {
    const double low = side > 0.0 ? -3.0 : -0.3, high = side > 0.0 ? 0.3 : 3.0;
    const Solid half(testing::joined(*open_box, *boxBetween({low, -3, 1}, {high, 3, 4})));
    EXPECT_FALSE(half.surface.isClosed()) << side;
  }
  const Solid whole(testing::joined(*open_box, *boxBetween({-3, -3, 1}, {3, 3, 4})));
  EXPECT_TRUE(whole.surface.isClosed());
}

/// A blade is open where it stands on a hub. One end of its rim is in the hub, the other one is above it.
TEST(SolidRoles, aPartThatIsOpenWhereItStandsOnAnother) {
  const SharedMesh hub = boxBetween({-5, -5, -2}, {5, 5, 0});
  const SharedMesh blade = without(*boxBetween({-1, -0.2, 0}, {1, 0.2, 3}),
                                   [](const Triangle& triangle) { return centroidOf(triangle).z() == 0.0; });
  for (const double low : {-0.1, 0.0, 0.001}) {
    for (const double high : {-0.5, 0.0, 0.002, 0.02, 0.3, 1.0}) {
      const SharedMesh tilted = testing::deformed(*blade, [&](const Vec3& v) {
        return v.z() > 0.0 ? v : Vec3(v.x(), v.y(), v.x() > 0.0 ? high : low);
      });
      const Solid rotor(testing::joined(*hub, *tilted));
      EXPECT_EQ(rotor.surface.isClosed(), high < 0.1) << low << ' ' << high;
      EXPECT_EQ(countOf(rotor.surface, TriangleRole::sheet) == 0, high < 0.1) << low << ' ' << high;
    }
  }
}

/// Both sides of a sheet are triangles with the same corners. They enclose nothing, and bodies touch them.
TEST(SolidRoles, aSheetWithTwoSidesStaysInTheBoundary) {
  const SharedMesh quad = testing::firstTriangles(*boxBetween({-2, -2, 0.5}, {2, 2, 1}), 2);
  const SharedMesh sheet = testing::joined(*quad, *testing::insideOut(*quad));
  const SharedMesh away = testing::moved(*sheet, {Mat3::Identity(), Vec3(9, 0, 0)});
  const SharedMesh cube = testing::boxMesh({1, 1, 1});
  const auto areaOf = [](const TriangleMesh& mesh) {
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
      area += 0.5 * scaledNormal(mesh.triangle(t)).norm();
    return area;
  };
  const Solid apart(testing::joined(*cube, *away)),
      twice(testing::joined(*testing::joined(*cube, *cube), *away));
  for (const Solid* solid : {&apart, &twice}) {
    EXPECT_TRUE(solid->surface.isClosed());
    EXPECT_NEAR(areaOf(solid->surface.boundary().mesh()), 24.0 + areaOf(*sheet), 1e-9);
    EXPECT_EQ(countOf(solid->surface, TriangleRole::sheet), 4u);
  }
  // Partly in the cube, only what is outside stays.
  const Solid through(testing::joined(*testing::joined(*cube, *cube), *sheet));
  const double height = quad->triangle(0)[0].z();
  const bool is_level = quad->bounds().halfExtents().z() == 0.0 && std::abs(height) < 1.0;
  ASSERT_TRUE(is_level);
  EXPECT_NEAR(areaOf(through.surface.boundary().mesh()), 24.0 + areaOf(*sheet) - 8.0, 1e-9);
}

/// Each face crosses all bars of the other layer.
TEST(SolidRoles, aGridOfBars_vs_closedForm) {
  constexpr int kBars = 20;
  constexpr double kWide = 0.05, kLong = 12.0, kCommon = 0.04;
  SharedMesh bars;
  for (int i = 0; i < kBars; ++i) {
    const double at = 0.1 * i;
    const SharedMesh crossing =
        testing::joined(*boxBetween({-1, at, 0}, {kLong - 1, at + kWide, kWide}),
                        *boxBetween({at, -1, 0.01}, {at + kWide, kLong - 1, kWide + 0.01}));
    bars = bars ? testing::joined(*bars, *crossing) : crossing;
  }
  const Solid solid(bars);
  EXPECT_TRUE(solid.surface.isClosed());
  const double expected = 2 * kBars * kLong * kWide * kWide - kBars * kBars * kWide * kWide * kCommon;
  EXPECT_NEAR(massProperties(solid.surface).volume, expected, 1e-10 * expected);
}

/// Thousands of triangles around one corner.
TEST(SolidRoles, fansAreWhole) {
  constexpr std::uint32_t kSegments = 1500;
  for (const double height : {0.0, 1.0}) {
    std::vector<Vec3> vertices = {Vec3(0, 0, height + 1), Vec3(0, 0, -height - 1)};
    std::vector<TriangleMesh::Indices> triangles;
    for (const double z : {1.0, -1.0}) {
      for (std::uint32_t i = 0; i < kSegments; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kSegments;
        vertices.emplace_back(std::cos(angle), std::sin(angle), z);
      }
    }
    for (std::uint32_t i = 0; i < kSegments; ++i) {
      const std::uint32_t a = 2 + i, b = 2 + (i + 1) % kSegments, c = a + kSegments, d = b + kSegments;
      triangles.insert(triangles.end(), {{0, a, b}, {1, d, c}, {a, c, b}, {b, c, d}});
    }
    const Solid solid(std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles)));
    EXPECT_TRUE(solid.surface.isWhole());
  }
}

}  // namespace
}  // namespace octoblisk
