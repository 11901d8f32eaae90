// Tests where a surface with holes, doubled triangles or overlaps bounds a solid, and what is inside it.
#include "octoblisk/solid_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/solid.h"
#include "geometry/triangle_pair.h"
#include "octoblisk/depth.h"
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
  return testing::bumpySphere(random, 1.0, 0.3, 14);
}
SharedMesh holed(const TriangleMesh& mesh) {
  return without(mesh, [](const Triangle& triangle) { return centroidOf(triangle).normalized().z() > 0.9; });
}

bool sharesCorner(const Triangle& a, const Triangle& b) {
  return std::ranges::any_of(a, [&](const Vec3& corner) { return std::ranges::find(b, corner) != b.end(); });
}

/// Computes the boundary by its definition, from every triangle pair and from winding numbers on both sides.
std::vector<bool> boundaryOf(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangleCount();
  std::vector<bool> bounds(count, true);
  for (std::size_t t = 0; t < count; ++t) {
    const Triangle triangle = mesh.triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      int same_way = 0, other_way = 0;
      for (std::size_t s = 0; s < count; ++s) {
        const Triangle other = mesh.triangle(s);
        for (std::size_t j = 0; j < 3 && s != t; ++j) {
          same_way += other[j] == triangle[i] && other[(j + 1) % 3] == triangle[(i + 1) % 3];
          other_way += other[(j + 1) % 3] == triangle[i] && other[j] == triangle[(i + 1) % 3];
        }
      }
      if (same_way != 0 || other_way != 1) bounds[t] = false;
    }
    for (std::size_t s = 0; s < count && bounds[t]; ++s) {
      const Triangle other = mesh.triangle(s);
      if (s != t && !sharesCorner(triangle, other) && detail::intersects(triangle, other)) bounds[t] = false;
    }
    const Vec3 normal = unitNormal(triangle);
    if (testing::windingNumber(mesh, centroidOf(triangle) + 1e-9 * normal) > 0.5) bounds[t] = false;
  }
  return bounds;
}

TEST(SolidBoundary, isWholeWhereTheSurfaceIsASolids) {
  for (const SharedMesh& mesh :
       {bumpy(), testing::torus(1.0, 0.3, 16, 8), testing::boxMesh({1, 2, 3}),
        testing::boxMesh({1e-9, 2e-9, 3e-9}),
        testing::joined(*testing::boxMesh({1, 1, 1}), *testing::torus(5, 1, 12, 8))}) {
    const Solid solid(mesh);
    EXPECT_TRUE(SolidBoundary(solid.surface).isWhole());
  }
}

TEST(SolidBoundary, triangles_vs_bruteforce) {
  const SharedMesh ball = bumpy(), ring = testing::torus(1.0, 0.35, 18, 10);
  const SharedMesh beside = testing::moved(*ring, {Mat3::Identity(), Vec3(1.1, 0.1, 0.05)});
  const auto isHigh = [](const Triangle& triangle) { return centroidOf(triangle).z() > -0.5; };
  const SharedMesh meshes[] = {holed(*ball),                                     // a hole
                               testing::joined(*ball, *without(*ball, isHigh)),  // doubled below
                               testing::joined(*ring, *beside),                  // overlapping
                               testing::joined(*holed(*ball), *beside)};         // both
  std::mt19937_64 random(6);
  for (const SharedMesh& mesh : meshes) {
    const Solid solid(mesh);
    const SolidBoundary boundary(solid.surface);
    EXPECT_FALSE(boundary.isWhole());
    const std::vector<bool> expected = boundaryOf(*mesh);
    std::size_t bounding = 0;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      ASSERT_EQ(boundary.has(t), expected[t]) << t;
      bounding += expected[t];
    }
    EXPECT_GT(bounding, 0u);
    EXPECT_LT(bounding, mesh->triangleCount());
    const SolidBoundary by_three(solid.surface, 3);
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) ASSERT_EQ(by_three.has(t), boundary.has(t));
  }
}

TEST(SolidBoundary, nothingBoundsWhereAllIsDoubledOrFacesInward) {
  const SharedMesh ring = testing::torus(1.0, 0.3, 16, 8);
  const auto count = [](const SharedMesh& mesh) {
    const Solid solid(mesh);
    const SolidBoundary boundary(solid.surface);
    std::size_t found = 0;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) found += boundary.has(t);
    return found;
  };
  EXPECT_EQ(count(testing::joined(*ring, *ring)), 0u);
  std::vector<TriangleMesh::Indices> turned;
  for (const auto& [a, b, c] : ring->triangles()) turned.push_back({a, c, b});
  turned.pop_back();
  EXPECT_EQ(count(std::make_shared<const TriangleMesh>(ring->vertices(), turned)), 0u);
}

TEST(SolidBoundary, locate_vs_theClosedSurface) {
  const Solid closed(bumpy()), open(holed(*closed.mesh));
  const SolidBoundary boundary(open.surface);
  std::mt19937_64 random(7);
  int inside = 0, unknown = 0, features[2] = {};
  constexpr int kPoints = 3000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 point = testing::randomPoint(random, 1.4);
    const PointLocation expected = locate(closed.surface, point), found = boundary.locate(point);
    const ClosestPoint nearest = closestPoint(open.tree, point).value();
    const auto corners = open.mesh->triangle(nearest.triangle);
    ++features[std::ranges::find(corners, nearest.point) != corners.end()];
    inside += expected == PointLocation::inside;
    if (found == PointLocation::unknown) {
      ++unknown;
      EXPECT_GT(point.z(), 0.3) << "only near the hole";
      continue;
    }
    // Between the missing surface and a flat lid over the hole, either answer is acceptable.
    if (point.z() > 0.75 && std::hypot(point.x(), point.y()) < 0.55) continue;
    ASSERT_EQ(found, expected) << point.transpose();
  }
  EXPECT_GT(inside, kPoints / 10);
  EXPECT_GT(features[1], kPoints / 20) << "nearest at a corner";
  EXPECT_GT(unknown, 5);
  EXPECT_LT(unknown, kPoints / 10);
}

TEST(SolidBoundary, depthDoesNotDependOnAHoleElsewhere) {
  const Solid closed(bumpy()), open(holed(*closed.mesh)), tool(testing::boxMesh({0.2, 0.3, 0.25}));
  const SolidBoundary whole(closed.surface), boundary(open.surface);
  constexpr double kTolerance = 1e-4;
  std::mt19937_64 random(8);
  DepthQuery query;
  int touching = 0, at_the_hole = 0, apart = 0, wrong = 0;
  for (int i = 0; i < 400; ++i) {
    const Pose pose{testing::randomRotation(random), testing::randomPoint(random, 1.3)};
    const GougeDepth expected = query.deepest(whole, tool.surface, pose, kTolerance);
    const GougeDepth found = query.deepest(boundary, tool.surface, pose, kTolerance);
    EXPECT_EQ(expected.depth, query.deepest(closed.surface, tool.surface, pose, kTolerance).depth);
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

TEST(SolidBoundary, depthIsNotKnownWhereTheSurfaceIsDoubledOrMeetsItself) {
  const SharedMesh ring = testing::torus(1.0, 0.35, 24, 12);
  const SharedMesh beside = testing::moved(*ring, {Mat3::Identity(), Vec3(1.1, 0.1, 0.05)});
  const Solid doubled(testing::joined(*ring, *ring)), overlapping(testing::joined(*ring, *beside));
  const Solid tool(testing::boxMesh({0.05, 0.06, 0.07}));
  const SolidBoundary of_doubled(doubled.surface), of_overlapping(overlapping.surface);
  DepthQuery query;
  const auto touches = [&](const SolidBoundary& boundary, const Vec3& place) {
    return query.deepest(boundary, tool.surface, {Mat3::Identity(), place}, 1e-4);
  };
  EXPECT_FALSE(touches(of_doubled, {-1.3, 0, 0}).is_known);
  const GougeDepth far_off = touches(of_overlapping, {-1.35, 0, 0});
  EXPECT_TRUE(far_off.is_known) << "the rings overlap elsewhere";
  EXPECT_EQ(far_off.gouging, Gouging::found);
  int known = 0, unknown = 0;
  std::mt19937_64 random(9);
  for (int i = 0; i < 300; ++i) {
    // In the overlap of the rings: parity says outside, which understates the depth.
    const Vec3 place = Vec3(0.55, 0.0, 0.0) + testing::randomPoint(random, 0.9);
    const bool in_both = locate(Solid(ring).surface, place) == PointLocation::inside &&
                         locate(Solid(beside).surface, place) == PointLocation::inside;
    if (!in_both) continue;
    const GougeDepth found = touches(of_overlapping, place);
    ++(found.is_known ? known : unknown);
  }
  EXPECT_EQ(known, 0);
  EXPECT_GT(unknown, 5);
}

TEST(SolidBoundary, isNeitherAroundNorBelowWhatIsNowhere) {
  const SharedMesh mesh = bumpy();
  for (const bool is_holed : {false, true}) {
    const Solid a(is_holed ? holed(*mesh) : mesh), b(mesh);
    const SolidBoundary boundary(a.surface);
    EXPECT_EQ(boundary.isWhole(), !is_holed);
    for (const double far :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e30}) {
      const Pose pose{Mat3::Identity(), Vec3(far, 0, 0)};
      EXPECT_EQ(boundary.locate(pose.translation), PointLocation::outside) << far;
      EXPECT_EQ(DepthQuery().deepest(boundary, b.surface, pose, 1e-6).gouging, Gouging::none) << far;
      EXPECT_EQ(DepthQuery().deepest(b.surface, b.surface, pose, 1e-6).gouging, Gouging::none) << far;
    }
  }
}

}  // namespace
}  // namespace octoblisk
