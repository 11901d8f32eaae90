// Compares the depth of gouges with closed forms and dense samples.
#include "octoblisk/depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/solid.h"
#include "shared/brute_force.h"
#include "shared/posed_vertices.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

Pose at(double x, double y, double z) { return {Mat3::Identity(), Vec3(x, y, z)}; }

/// Expects the witness to be on B, in or on A, and at the reported depth in A.
void expectWitness(const GougeDepth& found, const Solid& a, const Solid& b, const Pose& pose,
                   double rounding) {
  ASSERT_EQ(found.gouging, Gouging::found);
  ASSERT_LT(found.triangle_a, a.mesh->triangleCount());
  ASSERT_LT(found.triangle_b, b.mesh->triangleCount());
  EXPECT_LE(testing::bruteForceDistance(pose * b.mesh->triangle(found.triangle_b), found.point_on_b),
            rounding);
  EXPECT_LE(testing::bruteForceDistance(a.mesh->triangle(found.triangle_a), found.point_on_a), rounding);
  EXPECT_NEAR((found.point_on_a - found.point_on_b).norm(), found.depth, rounding);
  EXPECT_NEAR(testing::bruteForceDistance(*a.mesh, found.point_on_b), found.depth, rounding);
  if (found.depth > rounding) {
    EXPECT_GT(testing::windingNumber(*a.mesh, found.point_on_b), 0.5);
  }
}

/// A small box in an open one. Nothing bounds its depth, so a search that goes on never ends.
TEST(Depth, isNotSearchedForInAnOpenBox) {
  const auto cup = testing::firstTriangles(*testing::boxMesh({50, 50, 25}), 10);
  const ClusteredOctree open = ClusteredOctree::build(cup),
                        small = ClusteredOctree::build(testing::boxMesh({5, 5, 5}));
  const Surface in(open), box(small);
  for (const Vec3& place : {Vec3(2, 1, 10), Vec3(30, -20, -5), Vec3(0, 0, -19), Vec3(40, 40, 0)}) {
    const Pose pose{Mat3::Identity(), place};
    DepthQuery query;
    EXPECT_FALSE(query.deepest(in, box, pose, 1e-6).is_known) << place.transpose();
    EXPECT_GT(signedDistance(in, box, pose).distance, 0.0) << place.transpose();
  }
}

TEST(Depth, boxPressedIntoABox) {
  const Solid a(testing::boxMesh({5, 5, 5})), b(testing::boxMesh({1, 1, 1}));
  DepthQuery query;
  constexpr double kTolerance = 1e-6;
  for (const double depth : {0.0, 1e-7, 0.01, 0.5, 1.9}) {
    const Pose pose = at(0.3, -0.2, 6.0 - depth);
    const GougeDepth found = query.deepest(a.surface, b.surface, pose, kTolerance);
    expectWitness(found, a, b, pose, 1e-12);
    EXPECT_LE(found.depth, depth + 1e-12);
    EXPECT_GE(found.upper_bound, depth - 1e-12);
    EXPECT_LE(found.upper_bound, found.depth + kTolerance);
  }
  EXPECT_EQ(query.deepest(a.surface, b.surface, at(0, 0, std::nextafter(6.0, 7.0)), kTolerance).gouging,
            Gouging::none);
}

TEST(Depth, tippedBoxIsAsDeepAsItsLowestCorner) {
  const Solid a(testing::boxMesh({50, 50, 5})), b(testing::boxMesh({1, 2, 3}));
  DepthQuery query;
  std::mt19937_64 random(90);
  for (int i = 0; i < 60; ++i) {
    Pose pose{testing::randomRotation(random), testing::randomPoint(random, 20.0)};
    const double lowest = testing::lowestZ(*b.mesh, {pose.rotation, Vec3::Zero()});
    const double depth = std::pow(10.0, testing::uniform(random, -5.0, 0.5));
    pose.translation.z() = 5.0 - depth - lowest;
    const GougeDepth found = query.deepest(a.surface, b.surface, pose, 1e-7);
    expectWitness(found, a, b, pose, 1e-11);
    EXPECT_NEAR(found.depth, depth, 1e-7 + 1e-11) << i;
    EXPECT_GE(found.upper_bound, depth - 1e-11);
  }
}

TEST(Depth, theDeepestPointNeedNotBeAVertex) {
  const Solid a(testing::boxMesh({10, 10, 10})), b(testing::boxMesh({1, 2, 3}));
  DepthQuery query;
  const GougeDepth found = query.deepest(a.surface, b.surface, {}, 1e-6);
  expectWitness(found, a, b, {}, 1e-12);
  EXPECT_NEAR(found.depth, 9.0, 1e-6);  // the middles of the faces at x = ±1
  EXPECT_GE(found.upper_bound, 9.0 - 1e-12);
  EXPECT_LE(found.upper_bound, found.depth + 1e-6);
}

TEST(Depth, bladeTipThroughACoarseTriangle) {
  // B is a large facet that a corner of A cuts. No vertex of B is near.
  const Solid a(testing::boxMesh({1, 1, 1})), b(testing::boxMesh({40, 30, 1}));
  DepthQuery query;
  const Mat3 on_corner = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), Vec3(1, 1, 1)).toRotationMatrix();
  for (const double depth : {1e-4, 1e-3, 1e-2}) {
    // The plane cuts off a pyramid of that height. The deepest point of its base is the foot of the apex, at
    // equal distances from the three faces: height / √3.
    const Vec3 corner(1, 1, 1);
    const Pose pose{on_corner, corner * (1.0 - depth / std::sqrt(3.0)) + on_corner * Vec3(7.3, 5.1, 1.0)};
    const GougeDepth found = query.deepest(a.surface, b.surface, pose, 1e-3 * depth);
    expectWitness(found, a, b, pose, 1e-12);
    EXPECT_NEAR(found.depth, depth / std::sqrt(3.0), 1e-3 * depth);
    EXPECT_GE(found.upper_bound, depth / std::sqrt(3.0) - 1e-12);
  }
}

TEST(Depth, whatIsNotIn) {
  const Solid large(testing::boxMesh({3, 3, 3})), small(testing::boxMesh({1, 1, 1}));
  const Solid sheet(testing::waveSheet(1, 0.1, 8));
  DepthQuery query;
  EXPECT_EQ(query.deepest(large.surface, small.surface, at(9, 0, 0), 1e-3).gouging, Gouging::none);
  EXPECT_EQ(query.deepest(small.surface, large.surface, {}, 1e-3).gouging, Gouging::none);  // A inside B
  const GougeDepth in_sheet = query.deepest(sheet.surface, small.surface, {}, 1e-3);
  EXPECT_EQ(in_sheet.gouging, Gouging::found);  // they touch
  EXPECT_FALSE(in_sheet.is_known);
  const GougeDepth open = query.deepest(large.surface, sheet.surface, {}, 1e-6);  // B may be open
  expectWitness(open, large, sheet, {}, 1e-12);
  EXPECT_NEAR(open.depth, 3.0, 1e-6);
}

/// The deepest point of a grid on each of B's triangles, and the greatest distance of any point from the
/// grid.
struct Sample {
  double deepest = -1.0;
  double spacing = 0.0;
};

Sample sampleDepth(const TriangleMesh& a, const TriangleMesh& posed_b, int steps) {
  Sample sample;
  for (std::size_t t = 0; t < posed_b.triangleCount(); ++t) {
    const Triangle corner = posed_b.triangle(t);
    for (std::size_t e = 0; e < 3; ++e) {
      sample.spacing = std::max(sample.spacing, (corner[e] - corner[(e + 1) % 3]).norm() / steps);
    }
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 point =
            corner[0] + (corner[1] - corner[0]) * i / steps + (corner[2] - corner[0]) * j / steps;
        const Vec3 beyond = (point - a.bounds().center()).cwiseAbs() - a.bounds().halfExtents();
        if (beyond.maxCoeff() > 0.0) continue;
        const double distance = testing::bruteForceDistance(a, point);
        if (distance > sample.deepest && testing::windingNumber(a, point) > 0.5) sample.deepest = distance;
      }
    }
  }
  return sample;
}

TEST(Depth, randomSolids_vs_denseSamples) {
  std::mt19937_64 random(91);
  const Solid ring(testing::torus(2, 0.8, 16, 10)), ball(testing::bumpySphere(random, 1.0, 0.5, 12)),
      block(testing::boxMesh({0.4, 0.9, 1.6}));
  const auto solids = std::array{&ring, &ball, &block};
  DepthQuery query;
  int found_any = 0, poses = 0, shallow = 0;
  for (const Solid* a : solids) {
    for (const Solid* b : solids) {
      for (int i = 0; i < 8; ++i, ++poses) {
        const Pose pose = testing::randomPose(random, a == &ring || b == &ring ? 3.0 : 1.9);
        const double tolerance = i % 2 ? 1e-3 : 1e-5;
        const GougeDepth found = query.deepest(a->surface, b->surface, pose, tolerance);
        const Sample sample = sampleDepth(*a->mesh, *testing::moved(*b->mesh, pose), b == &block ? 40 : 6);
        const bool meet = !testing::bruteForcePairs(*a->mesh, *b->mesh, pose).empty();
        ASSERT_EQ(found.gouging == Gouging::found, meet || sample.deepest >= 0.0);
        if (found.gouging != Gouging::found) continue;
        ++found_any;
        shallow += found.depth < 0.2;
        expectWitness(found, *a, *b, pose, 1e-12);
        ASSERT_LE(found.upper_bound, found.depth + tolerance);
        ASSERT_GE(found.upper_bound, sample.deepest - 1e-12);
        ASSERT_LE(found.depth, std::max(sample.deepest, 0.0) + sample.spacing);
        // The result of a finer tolerance lies within the bounds of a coarser one.
        const GougeDepth coarse = query.deepest(a->surface, b->surface, pose, 0.1);
        ASSERT_LE(coarse.depth, found.upper_bound + 1e-12);
        ASSERT_GE(coarse.upper_bound, found.depth - 1e-12);
      }
    }
  }
  EXPECT_GE(found_any, poses * 3 / 10);
  EXPECT_LE(found_any, poses * 7 / 10);
  EXPECT_GE(shallow, 5);
}

TEST(Depth, depthsSoughtBoundTheSameDepth) {
  std::mt19937_64 random(95);
  const Solid ring(testing::torus(2, 0.8, 32, 20)), ball(testing::bumpySphere(random, 1.0, 0.5, 24));
  DepthQuery query;
  constexpr double kTolerance = 1e-3;
  int deep = 0, ended_early = 0, ignored = 0;
  for (int i = 0; i < 60; ++i) {
    const Pose pose = testing::randomPose(random, 2.0);
    const Solid &a = i % 3 ? ring : ball, &b = i % 2 ? ring : ball;
    const GougeDepth exact = query.deepest(a.surface, b.surface, pose, 1e-6);
    if (exact.depth < 0.05) continue;
    ++deep;
    for (const double factor : {0.2, 0.9, 0.999, 1.001, 1.1, 2.0}) {
      const double above = factor * exact.depth;
      const GougeDepth over = query.deepest(a.surface, b.surface, pose, kTolerance, {.above = above});
      ASSERT_EQ(over.gouging, Gouging::found);
      expectWitness(over, a, b, pose, 1e-12);
      ASSERT_LE(over.depth, exact.upper_bound + 1e-12);
      ASSERT_GE(over.upper_bound, exact.depth - 1e-12);
      ASSERT_LE(over.upper_bound, std::max(over.depth, above) + kTolerance + 1e-12);
      ignored += over.depth + kTolerance < exact.depth;

      const double enough = above;
      const GougeDepth until = query.deepest(a.surface, b.surface, pose, kTolerance, {.enough = enough});
      ASSERT_EQ(until.gouging, Gouging::found);
      expectWitness(until, a, b, pose, 1e-12);
      ASSERT_LE(until.depth, exact.upper_bound + 1e-12);
      if (until.depth > enough) {
        ASSERT_TRUE(std::isinf(until.upper_bound));
        ended_early += until.depth + kTolerance < exact.depth;
      } else {
        ASSERT_LE(exact.depth, until.upper_bound + 1e-12);
        ASSERT_LE(until.upper_bound, until.depth + kTolerance);
      }
    }
  }
  EXPECT_GE(deep, 20);
  EXPECT_GE(ended_early, deep / 2);
  EXPECT_GE(ignored, deep);
}

TEST(Depth, cellsOfAGrid) {
  // All coordinates are integers and halves: coplanar faces, shared edges, corners on faces.
  std::mt19937_64 random(92);
  const testing::Voxels cells_a = testing::randomVoxels(random, 4),
                        cells_b = testing::randomVoxels(random, 3);
  const Solid a(cells_a.mesh), b(cells_b.mesh);
  DepthQuery query;
  int inside = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3 offset = 0.5 * testing::randomPoint(random, 8).array().round().matrix();
    const Pose pose{Mat3::Identity(), offset};
    const GougeDepth found = query.deepest(a.surface, b.surface, pose, 1e-4);
    const Sample sample = sampleDepth(*a.mesh, *testing::moved(*b.mesh, pose), 8);
    const bool meet = !testing::bruteForcePairs(*a.mesh, *b.mesh, pose).empty();
    ASSERT_EQ(found.gouging == Gouging::found, meet || sample.deepest >= 0.0) << i;
    if (found.gouging != Gouging::found) continue;
    inside += found.depth > 0.1;
    expectWitness(found, a, b, pose, 1e-12);
    ASSERT_LE(found.upper_bound, found.depth + 1e-4);
    ASSERT_GE(found.upper_bound, sample.deepest - 1e-12);
    ASSERT_LE(found.depth, std::max(sample.deepest, 0.0) + sample.spacing);
  }
  EXPECT_GE(inside, 4);
}

TEST(Depth, pinInAHoleOfOneMicrometreClearance) {
  // Surfaces that run side by side, each facet over many triangles of the other. These once took 18 s per
  // pose.
  constexpr std::uint32_t kFacets = 720;
  const Solid hole(testing::tube(5.001, 10.0, 5.0, kFacets)), pin(testing::tube(2.0, 5.0, 10.0, kFacets));
  const double clearance = 0.001 * std::cos(std::numbers::pi / kFacets);  // of two parallel facets
  DepthQuery query;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    for (const double depth : {1e-6, 1e-5, 2e-4, 4e-3}) {
      const Pose pose = at(clearance + depth, 0.0, 0.3);
      for (const bool pin_is_solid : {false, true}) {
        const Solid &a = pin_is_solid ? pin : hole, &b = pin_is_solid ? hole : pin;
        const Pose b_in_a = pin_is_solid ? pose.inverse() : pose;
        const GougeDepth found = query.deepest(a.surface, b.surface, b_in_a, tolerance);
        expectWitness(found, a, b, b_in_a, 1e-12);
        EXPECT_LE(found.depth, depth + 1e-12);
        EXPECT_GE(found.upper_bound, depth - 1e-12);
        EXPECT_LE(found.upper_bound, found.depth + tolerance);
      }
    }
    EXPECT_EQ(query.deepest(hole.surface, pin.surface, at(clearance - 1e-9, 0.0, 0.3), tolerance).gouging,
              Gouging::none);
  }
}

TEST(Depth, ofASurfaceOnItselfIsZero) {
  std::mt19937_64 random(95);
  const SharedMesh ring = testing::torus(2, 0.8, 32, 20), ball = testing::bumpySphere(random, 1.0, 0.5, 24);
  DepthQuery query;
  for (const SharedMesh& mesh : {ring, ball}) {
    std::vector<std::array<std::uint32_t, 3>> shuffled(mesh->triangles().begin(), mesh->triangles().end());
    std::ranges::shuffle(shuffled, random);
    const Solid a(mesh), copy(mesh),
        other(std::make_shared<const TriangleMesh>(
            std::vector<Vec3>(mesh->vertices().begin(), mesh->vertices().end()), std::move(shuffled)));
    for (const Solid* b : {&a, &copy, &other}) {
      for (const double tolerance : {1e-3, 1e-6, 0.0}) {
        const GougeDepth found = query.deepest(a.surface, b->surface, {}, tolerance);
        expectWitness(found, a, *b, {}, 1e-12);
        EXPECT_EQ(found.depth, 0.0);
        EXPECT_LE(found.upper_bound, std::max(tolerance, 1e-11));
      }
    }
  }
  // A turn by one segment maps the ring onto itself, except for rounding.
  const Solid a(ring);
  const Pose turned{Eigen::AngleAxisd(2.0 * std::numbers::pi / 32, Vec3::UnitZ()).toRotationMatrix(),
                    Vec3::Zero()};
  const GougeDepth found = query.deepest(a.surface, a.surface, turned, 1e-9);
  EXPECT_EQ(found.gouging, Gouging::found);
  EXPECT_EQ(found.depth, 0.0);
  EXPECT_LE(found.upper_bound, 1e-9);
}

TEST(Depth, flatTrianglesHideNothing) {
  // B is a block whose bottom lies, in whole or in part, on A's top within the tolerance. A peg below it
  // enters A.
  const Solid a(testing::boxMesh({5, 5, 5}));
  const SharedMesh block = testing::boxMesh({2, 2, 1});
  DepthQuery query;
  constexpr double kTolerance = 1e-3;
  for (const double height : {-0.5e-3, -1e-9, 0.0, 1e-9, 0.5e-3}) {
    for (const double depth : {0.0, 0.4}) {
      // The peg is unconnected, or goes through the bottom.
      const SharedMesh peg = testing::moved(*testing::boxMesh({0.5, 0.5, 0.2 + depth}), at(0.3, 0.2, -1.0));
      const Solid b(depth > 0.0 ? testing::joined(*block, *peg) : block);
      const Pose pose = at(0.1, 0.2, 6.0 + height);
      const GougeDepth found = query.deepest(a.surface, b.surface, pose, kTolerance);
      const double deepest = depth > 0.0 ? 0.2 + depth - height : std::max(0.0, -height);
      ASSERT_EQ(found.gouging, depth == 0.0 && height > 0.0 ? Gouging::none : Gouging::found) << height;
      EXPECT_LE(found.depth, deepest + 1e-12);
      EXPECT_GE(found.upper_bound, deepest - 1e-12);
      EXPECT_LE(found.upper_bound, found.depth + kTolerance);
    }
  }
}

TEST(Depth, answersDoNotDependOnWhatWasAskedBefore) {
  std::mt19937_64 random(93);
  const Solid ring(testing::torus(2, 0.8, 32, 20)), ball(testing::bumpySphere(random, 1.0, 0.5, 24));
  DepthQuery warm;
  for (int i = 0; i < 40; ++i) {
    const Pose pose = testing::randomPose(random, 2.0);
    const Solid &a = i % 3 ? ring : ball, &b = i % 2 ? ring : ball;
    DepthQuery fresh;
    const GougeDepth first = fresh.deepest(a.surface, b.surface, pose, 1e-4);
    const GougeDepth second = warm.deepest(a.surface, b.surface, pose, 1e-4);
    ASSERT_EQ(first.gouging, second.gouging);
    ASSERT_EQ(first.depth, second.depth);
    ASSERT_EQ(first.upper_bound, second.upper_bound);
    ASSERT_EQ(first.point_on_b, second.point_on_b);
    ASSERT_EQ(first.triangle_a, second.triangle_a);
    ASSERT_EQ(first.triangle_b, second.triangle_b);
  }
}

TEST(Depth, tinyHugeAndFar) {
  std::mt19937_64 random(94);
  const SharedMesh ring = testing::torus(2, 0.8, 32, 20), ball = testing::bumpySphere(random, 1.0, 0.5, 24);
  const Solid a(ring), b(ball);
  const Pose pose = at(2.2, 0.3, 0.9);
  DepthQuery query;
  const GougeDepth expected = query.deepest(a.surface, b.surface, pose, 1e-5);
  ASSERT_GT(expected.depth, 0.1);
  for (const double scale : {1e-12, 1e-6, 1e6, 1e11}) {
    const Solid scaled_a(testing::moved(*ring, {}, scale)), scaled_b(testing::moved(*ball, {}, scale));
    const Pose scaled_pose{pose.rotation, scale * pose.translation};
    const GougeDepth found = query.deepest(scaled_a.surface, scaled_b.surface, scaled_pose, 1e-5 * scale);
    EXPECT_NEAR(found.depth / scale, expected.depth, 1e-5) << scale;
    EXPECT_LE(found.upper_bound, found.depth + 1e-5 * scale) << scale;
  }
  const Vec3 far(1e6, -3e6, 2e6);
  const Solid far_a(testing::moved(*ring, {Mat3::Identity(), far}));
  const GougeDepth found =
      query.deepest(far_a.surface, b.surface, {pose.rotation, pose.translation + far}, 1e-5);
  EXPECT_NEAR(found.depth, expected.depth, 1.1e-5);
  EXPECT_EQ(query.deepest(a.surface, b.surface, pose, 0.0).gouging, Gouging::found);  // raised to 1e-12
}

/// A triangle through a thin wall. The middle of a cut may lie exactly on the wall.
TEST(Depth, aPartWithACornerOnTheSurfaceIsNotTakenToBeInside) {
  constexpr double kInner = 0.94769709439685212;
  const SharedMesh cavity = testing::insideOut(*testing::boxMesh(Vec3::Constant(kInner)));
  const Solid shell(testing::joined(*testing::boxMesh({1, 1, 1}), *cavity));
  const Vec3 a(-0.96424651073560208, -0.26257278086613928, -1.5588363927613025),
      b(-0.13592183045904938, 3.0939373771491008, 0.33957713051812666),
      c(0.45444729810631335, -2.3336402299038577, 3.9671070150778882);
  DepthQuery query;
  for (const auto& corners : {std::vector{a, b, c}, std::vector{c, b, a}}) {
    const Solid triangle(
        std::make_shared<const TriangleMesh>(corners, std::vector<TriangleMesh::Indices>{{0, 1, 2}}));
    const GougeDepth found = query.deepest(shell.surface, triangle.surface, {}, 1e-6);
    expectWitness(found, shell, triangle, {}, 1e-12);
    EXPECT_LE(found.upper_bound, (2.0 - std::numbers::sqrt2) * (1.0 - kInner) + 1e-6);
  }
}

}  // namespace
}  // namespace octoblisk
