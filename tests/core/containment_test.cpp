// Tests points and solids in solids against winding numbers, grids of cells and closed forms.
#include "octoblisk/containment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/solid.h"
#include "geometry/half_line_crossing.h"
#include "shared/brute_force.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::SharedMesh;

/// Rounds all coordinates to multiples of 2^-16, so that midpoints of edges and faces are exact.
SharedMesh rounded(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) {
    vertices.push_back(v.unaryExpr([](double x) { return std::round(x * 0x1p16) * 0x1p-16; }));
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), mesh.triangles());
}

TEST(Locate, cells_atAllMultiplesOfAHalf) {
  std::mt19937_64 random(80);
  for (const int size : {2, 4, 6}) {
    const testing::Voxels voxels = testing::randomVoxels(random, size);
    for (const PartitionKind kind : {PartitionKind::clustering, PartitionKind::paper}) {
      const Solid solid(voxels.mesh, kind);
      ASSERT_TRUE(solid.surface.isOriented());
      std::map<PointLocation, int> count;
      for (int i = -1; i <= 2 * size + 1; ++i) {
        for (int j = -1; j <= 2 * size + 1; ++j) {
          for (int k = -1; k <= 2 * size + 1; ++k) {
            int full = 0;  // of the eight cells that contain the point or meet at it
            for (int n = 0; n < 8; ++n) {
              const auto cell = [](int twice, int up) { return (twice - (up ? 0 : 1) + 1024) / 2 - 512; };
              full += voxels.at(cell(i, n & 1), cell(j, n & 2), cell(k, n & 4));
            }
            const PointLocation expected = full == 0   ? PointLocation::outside
                                           : full == 8 ? PointLocation::inside
                                                       : PointLocation::on_surface;
            ASSERT_EQ(locate(solid.surface, 0.5 * Vec3(i, j, k)), expected) << i << ' ' << j << ' ' << k;
            ++count[expected];
          }
        }
      }
      if (size == 6) {
        EXPECT_GT(count[PointLocation::inside], 100);
        EXPECT_GT(count[PointLocation::outside], 100);
        EXPECT_GT(count[PointLocation::on_surface], 100);
      }
    }
  }
}

TEST(Locate, randomPoints_vs_windingNumber) {
  std::mt19937_64 random(81);
  const SharedMesh ring = testing::torus(3, 1.4, 24, 16), ball = testing::bumpySphere(random, 2.0, 1.2, 24);
  const Pose turned{testing::randomRotation(random), Vec3(1, 2, 3)};
  const Pose far{testing::randomRotation(random), Vec3(1e6, -2e6, 3e6)};
  const Pose mirrored{-Mat3::Identity(), Vec3::Zero()};  // faces inward
  for (const SharedMesh& mesh : {ring, ball, testing::moved(*ball, mirrored), testing::moved(*ring, turned),
                                 testing::moved(*ball, far), testing::moved(*ring, Pose{}, 1e-10),
                                 testing::moved(*ball, Pose{}, 1e10)}) {
    const Solid solid(mesh);
    int inside = 0;
    constexpr int kPoints = 600;
    for (int i = 0; i < kPoints; ++i) {
      const Vec3 extents = 0.9 * mesh->bounds().halfExtents();
      const Vec3 point = mesh->bounds().center() + testing::randomPoint(random, 1.0).cwiseProduct(extents);
      const bool expected = std::abs(testing::windingNumber(*mesh, point)) > 0.5;
      ASSERT_EQ(locate(solid.surface, point), expected ? PointLocation::inside : PointLocation::outside);
      inside += expected;
    }
    EXPECT_GE(inside, kPoints * 3 / 10);
    EXPECT_LE(inside, kPoints * 7 / 10);
  }
}

TEST(Locate, posed_vs_windingNumber) {
  std::mt19937_64 random(82);
  const Solid solid(testing::bumpySphere(random, 2.0, 1.2, 20));
  int inside = 0;
  constexpr int kPoints = 400;
  for (int i = 0; i < kPoints; ++i) {
    const Pose pose = testing::randomPose(random, i % 2 ? 1.0 : 1e5);
    const Vec3 point = pose.translation + testing::randomPoint(random, 1.7);
    const bool expected = testing::windingNumber(*testing::moved(*solid.mesh, pose), point) > 0.5;
    ASSERT_EQ(locate(solid.surface, point, pose), expected ? PointLocation::inside : PointLocation::outside);
    inside += expected;
  }
  EXPECT_GE(inside, kPoints * 3 / 10);
  EXPECT_LE(inside, kPoints * 7 / 10);
}

TEST(Locate, linesOfSightThroughVerticesAndEdges) {
  std::mt19937_64 random(83);
  for (const SharedMesh& mesh : {rounded(*testing::torus(3, 1, 16, 12)), testing::boxMesh({1, 2, 4}),
                                 rounded(*testing::bumpySphere(random, 2.0, 1.0, 16))}) {
    const Solid solid(mesh);
    int inside = 0, outside = 0;
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      const Triangle triangle = mesh->triangle(t);
      const Vec3 vertex = triangle[0], edge = 0.5 * (triangle[0] + triangle[1]);
      const Vec3 face = 0.5 * edge + 0.5 * triangle[2];
      for (const Vec3& exact : {vertex, edge, face}) {
        ASSERT_EQ(locate(solid.surface, exact), PointLocation::on_surface);
        for (int i = 0; i < 6; ++i) {
          Vec3 point = exact;  // behind the feature, before it, or far away
          point.x() += i < 4 ? testing::uniform(random, -2, 2) : (i == 4 ? -100 : 100);
          const double winding = testing::windingNumber(*mesh, point);
          if (testing::bruteForceDistance(*mesh, point) < 1e-9) continue;  // slides along a face
          ASSERT_EQ(locate(solid.surface, point),
                    winding > 0.5 ? PointLocation::inside : PointLocation::outside);
          ++(winding > 0.5 ? inside : outside);
        }
        // A point one unit in the last place off the surface is not on it, unless the surface runs along x.
        const Vec3 next(std::nextafter(exact.x(), 100.0), exact.y(), exact.z());
        const bool on = std::ranges::any_of(mesh->triangles(), [&](const TriangleMesh::Indices& index) {
          return halfLineCrossing(next, {mesh->vertices()[index[0]], mesh->vertices()[index[1]],
                                         mesh->vertices()[index[2]]}) == Crossing::on_triangle;
        });
        ASSERT_EQ(locate(solid.surface, next) == PointLocation::on_surface, on);
      }
    }
    EXPECT_GT(inside, 10);
    EXPECT_GT(outside, 100);
  }
}

TEST(Locate, roundsTheWindingNumberOfOpenSurfaces) {
  const SharedMesh box = testing::boxMesh({1, 1, 1});
  const Solid open(testing::firstTriangles(*box, 11)), half(testing::firstTriangles(*box, 6));
  EXPECT_NEAR(windingNumber(open.surface, Vec3::Zero()), 11.0 / 12.0, 1e-14);
  EXPECT_EQ(locate(open.surface, Vec3::Zero()), PointLocation::inside);
  EXPECT_EQ(locate(open.surface, Vec3(9, 9, 9)), PointLocation::outside);
  EXPECT_EQ(locate(open.surface, Vec3(0, 0, 1)), PointLocation::on_surface);
  std::mt19937_64 random(85);
  int inside = 0;
  constexpr int kPoints = 1000;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 point = testing::randomPoint(random, 1.2);
    const double expected = testing::windingNumber(*half.mesh, point);
    ASSERT_NEAR(windingNumber(half.surface, point), expected, 1e-12);
    if (std::abs(std::abs(expected) - 0.5) < 1e-9) continue;
    const bool is_inside = std::abs(expected) > 0.5;
    ASSERT_EQ(locate(half.surface, point), is_inside ? PointLocation::inside : PointLocation::outside);
    inside += is_inside;
  }
  EXPECT_GE(inside, kPoints * 15 / 100);
  EXPECT_LE(inside, kPoints * 7 / 10);
}

TEST(Locate, insideIsWhereTheWindingNumberIsNotZero) {
  const SharedMesh box = testing::boxMesh({1, 1, 1}), large = testing::boxMesh({3, 3, 3});
  const Solid lobes(testing::joined(*box, *testing::moved(*box, {Mat3::Identity(), Vec3(1, 0.5, 0.5)})));
  const Vec3 in_both(0.5, 0.2, 0.3);
  EXPECT_EQ(locate(lobes.surface, Vec3(-0.5, 0, 0)), PointLocation::inside);
  EXPECT_EQ(locate(lobes.surface, in_both), PointLocation::inside);
  EXPECT_EQ(windingNumber(lobes.surface, in_both), 2.0);
  EXPECT_EQ(locate(lobes.surface, Vec3(1.5, 0.9, 0.9)), PointLocation::inside);
  EXPECT_EQ(locate(lobes.surface, Vec3(-0.5, 1.2, 0)), PointLocation::outside);
  const Solid same_way(testing::joined(*large, *box)),
      hollow(testing::joined(*large, *testing::insideOut(*box)));
  for (const Solid* nested : {&same_way, &hollow}) {
    EXPECT_EQ(locate(nested->surface, Vec3(2, 0.1, 0.1)), PointLocation::inside);
    EXPECT_EQ(locate(nested->surface, Vec3(0.5, 0.1, 0.1)),
              nested == &hollow ? PointLocation::outside : PointLocation::inside);
  }
  const Solid inside_out(testing::insideOut(*box));
  EXPECT_EQ(windingNumber(inside_out.surface, Vec3::Zero()), -1.0);
  EXPECT_EQ(locate(inside_out.surface, Vec3::Zero()), PointLocation::inside);
  const Solid flat(testing::boxMesh({1, 0, 1}));  // two coincident sheets enclose nothing
  EXPECT_EQ(locate(flat.surface, Vec3(0, 0, 0)), PointLocation::on_surface);
  EXPECT_EQ(locate(flat.surface, Vec3(-3, 0, 0)), PointLocation::outside);
}

TEST(Containment, closedForms) {
  const Solid large(testing::boxMesh({3, 3, 3})), small(testing::boxMesh({1, 1, 1}));
  const Solid ring(testing::torus(3, 1, 32, 16)), ball(testing::torus(0.6, 0.4, 16, 8));
  const Solid open(testing::waveSheet(1, 0.1, 4));
  const auto at = [](double x, double y, double z) { return Pose{Mat3::Identity(), Vec3(x, y, z)}; };
  EXPECT_EQ(containment(large.surface, small.surface, {}), Containment::b_inside_a);
  EXPECT_EQ(containment(small.surface, large.surface, {}), Containment::a_inside_b);
  EXPECT_EQ(containment(large.surface, small.surface, at(2, 0, 0)), Containment::touching);
  EXPECT_EQ(containment(large.surface, small.surface, at(2.0 - 1e-15, 0, 0)), Containment::b_inside_a);
  EXPECT_EQ(containment(large.surface, small.surface, at(4, 0, 0)), Containment::touching);
  EXPECT_EQ(containment(large.surface, small.surface, at(std::nextafter(4.0, 5.0), 0, 0)),
            Containment::apart);
  EXPECT_EQ(containment(ring.surface, ball.surface, {}), Containment::apart);  // in the hole
  EXPECT_EQ(containment(large.surface, open.surface, {}), Containment::unknown);
  EXPECT_EQ(containment(open.surface, large.surface, at(3, 0, 0)), Containment::touching);

  const SharedMesh cavity = testing::insideOut(*testing::boxMesh({3, 3, 3}));
  const Solid hollow(testing::joined(*testing::boxMesh({9, 9, 9}), *cavity));
  EXPECT_EQ(containment(hollow.surface, small.surface, {}), Containment::apart);
  EXPECT_EQ(containment(small.surface, hollow.surface, {}), Containment::apart);
  EXPECT_EQ(containment(hollow.surface, small.surface, at(6, 0, 0)), Containment::b_inside_a);
  const Solid ample(testing::boxMesh({5, 5, 5}));  // its middle fills the cavity, its rim is in the solid
  EXPECT_EQ(containment(hollow.surface, ample.surface, {}), Containment::overlapping);
  const Solid two(testing::joined(*small.mesh, *testing::moved(*small.mesh, at(20, 0, 0))));
  EXPECT_EQ(containment(large.surface, two.surface, {}), Containment::overlapping);
  EXPECT_EQ(containment(large.surface, two.surface, at(-10, 0, 0)), Containment::apart);
  const Solid huge(testing::boxMesh({90, 90, 90}));
  EXPECT_EQ(containment(huge.surface, two.surface, {}), Containment::b_inside_a);
  EXPECT_EQ(containment(two.surface, huge.surface, {}), Containment::a_inside_b);
}

TEST(Containment, randomSolids_vs_bruteforce) {
  std::mt19937_64 random(84);
  const Solid ring(testing::torus(3, 1.5, 24, 12)), ball(testing::bumpySphere(random, 0.6, 0.2, 12)),
      cup(testing::bumpySphere(random, 3.0, 1.0, 16));
  std::map<Containment, int> count;
  const auto check = [&](const Solid& a, const Solid& b, const Pose& pose) {
    const SharedMesh posed = testing::moved(*b.mesh, pose);
    Containment expected = Containment::apart;
    if (!testing::bruteForcePairs(*a.mesh, *b.mesh, pose).empty()) {
      expected = Containment::touching;
    } else if (testing::windingNumber(*a.mesh, posed->vertices()[0]) > 0.5) {
      expected = Containment::b_inside_a;
    } else if (testing::windingNumber(*posed, a.mesh->vertices()[0]) > 0.5) {
      expected = Containment::a_inside_b;
    }
    ++count[expected];
    return containment(a.surface, b.surface, pose) == expected;
  };
  constexpr int kPoses = 150;
  for (int i = 0; i < kPoses; ++i) {
    const Pose pose = testing::randomPose(random, 3.5);
    ASSERT_TRUE(check(ring, ball, pose)) << i;
    ASSERT_TRUE(check(cup, ball, pose)) << i;
    ASSERT_TRUE(check(ball, cup, pose.inverse())) << i;
  }
  for (const Containment kind :
       {Containment::apart, Containment::touching, Containment::a_inside_b, Containment::b_inside_a}) {
    EXPECT_GT(count[kind], 20) << static_cast<int>(kind);
  }
  EXPECT_GE(count[Containment::touching], 3 * kPoses * 3 / 10);
  EXPECT_LE(count[Containment::touching], 3 * kPoses * 7 / 10);
}

}  // namespace
}  // namespace octoblisk
