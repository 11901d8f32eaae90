#include "models/blade_finder.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "demos/block.h"
#include "models/blisk.h"
#include "shared/meshes.h"

namespace octoblisk::demos {
namespace {

constexpr int kBlades = 24;
constexpr double kPitch = 2.0 * std::numbers::pi / kBlades;

Blisk shroudedBlisk() {
  BliskOptions options;
  options.shroud = true;
  options.target_triangles = 20'000;
  return makeBlisk(makeBladeSections({}), cylinderProfile(128.0, 100.0), options);
}

TriangleMesh turned(const TriangleMesh& mesh, double angle) {
  std::vector<Vec3> vertices = mesh.vertices();
  for (Vec3& vertex : vertices) vertex = Eigen::AngleAxisd(angle, Vec3::UnitZ()) * vertex;
  return TriangleMesh(std::move(vertices), mesh.triangles());
}

/// The same triangles without shared vertices.
TriangleMesh unwelded(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : mesh.triangle(t)) vertices.push_back(corner);
    triangles.push_back({first, first + 1, first + 2});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

/// Blades with their own triangles that pass through an open cylinder, as lofting makes them.
Blisk bladesThroughAnOpenHub() {
  const Blisk whole = makeDefaultBlisk(20'000);
  std::vector<Vec3> vertices = whole.mesh.vertices();
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<int> blade_of_triangle;
  for (std::size_t t = 0; t < whole.mesh.triangleCount(); ++t) {
    if (whole.blade_of_triangle[t] == 0) continue;
    triangles.push_back(whole.mesh.triangles()[t]);
    blade_of_triangle.push_back(whole.blade_of_triangle[t]);
  }
  constexpr int kSegments = 360;
  constexpr double kHubAtFront = 130.0;
  constexpr double kHubAtBack = 145.0;
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (int k = 0; k < kSegments; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kSegments;
    const Vec3 outward(std::cos(angle), std::sin(angle), 0.0);
    vertices.push_back(kHubAtFront * outward - 100.0 * Vec3::UnitZ());
    vertices.push_back(kHubAtBack * outward + 100.0 * Vec3::UnitZ());
  }
  for (std::uint32_t k = 0; k < kSegments; ++k) {
    const std::uint32_t here = first + 2 * k;
    const std::uint32_t next = first + 2 * ((k + 1) % kSegments);
    triangles.push_back({here, next, next + 1});
    triangles.push_back({here, next + 1, here + 1});
    blade_of_triangle.insert(blade_of_triangle.end(), {0, 0});
  }
  return {TriangleMesh(std::move(vertices), std::move(triangles)), std::move(blade_of_triangle)};
}

/// An octahedron whose triangles are divided into four repeatedly.
TriangleMesh sphere(double radius, int halvings) {
  std::vector<Triangle> faces;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) faces.push_back({Vec3(x, 0, 0), Vec3(0, y, 0), Vec3(0, 0, z)});
    }
  }
  for (int k = 0; k < halvings; ++k) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : faces) {
      const Vec3 ab = (a + b).normalized();
      const Vec3 bc = (b + c).normalized();
      const Vec3 ca = (c + a).normalized();
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (const Triangle& face : faces) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : face) vertices.push_back(radius * corner);
    triangles.push_back({first, first + 1, first + 2});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

/// At least 95 % of the blades' triangles have their number; none has another blade's, and the rings have
/// none.
void expectNumbersOf(const Blisk& blisk, const BladesFound& found) {
  ASSERT_EQ(found.count, kBlades);
  ASSERT_EQ(found.blade_of_triangle.size(), blisk.mesh.triangleCount());
  std::size_t of_blades = 0;
  std::size_t right = 0;
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < blisk.mesh.triangleCount(); ++t) {
    const int expected = blisk.blade_of_triangle[t];
    const int actual = found.blade_of_triangle[t];
    of_blades += expected != 0;
    right += expected != 0 && actual == expected;
    wrong += actual != 0 && actual != expected;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GE(static_cast<double>(right), 0.95 * static_cast<double>(of_blades));
}

void expectNoBlades(const TriangleMesh& mesh) {
  const BladesFound found = findBlades(mesh);
  EXPECT_EQ(found.count, 0);
  EXPECT_EQ(found.blade_of_triangle, std::vector<int>(mesh.triangleCount(), 0));
  EXPECT_EQ(found.root_radius, 0.0);
  EXPECT_EQ(found.tip_radius, 0.0);
}

TEST(BladeFinder, numbersTheBladesOfAGeneratedBliskAsTheGenerator) {
  for (const std::size_t target : {10'000u, 50'000u}) {
    const Blisk blisk = makeDefaultBlisk(target);
    const BladesFound found = findBlades(blisk.mesh);
    expectNumbersOf(blisk, found);
    EXPECT_NEAR(found.root_radius, 128.0, 1e-9);
    EXPECT_NEAR(found.tip_radius, 240.0, 1e-9);
  }
}

TEST(BladeFinder, findsTheBladesUnderAShroud) {
  const Blisk blisk = shroudedBlisk();
  const BladesFound found = findBlades(blisk.mesh);
  expectNumbersOf(blisk, found);
  EXPECT_NEAR(found.root_radius, 128.0, 1e-9);
  EXPECT_NEAR(found.tip_radius, 240.0, 0.01);
  EXPECT_TRUE(found.shrouded);
  EXPECT_FALSE(findBlades(makeDefaultBlisk(10'000).mesh).shrouded);
}

TEST(BladeFinder, findsBladesThatGoThroughAnOpenHubOfVaryingRadius) {
  const Blisk blisk = bladesThroughAnOpenHub();
  const BladesFound found = findBlades(blisk.mesh);
  expectNumbersOf(blisk, found);
  EXPECT_NEAR(found.root_radius, 145.0, 1e-9) << "the hub's greatest radius";
}

TEST(BladeFinder, needsNoSharedVertices) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  expectNumbersOf({unwelded(blisk.mesh), blisk.blade_of_triangle}, findBlades(unwelded(blisk.mesh)));
}

TEST(BladeFinder, numbersStartAtTheTipNearestToAngleZeroHoweverTheBliskIsTurned) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  for (const double pitches : {0.3, 0.7, 5.2, -0.4, 23.9}) {
    Blisk expected{turned(blisk.mesh, pitches * kPitch), blisk.blade_of_triangle};
    const int shift = static_cast<int>(std::lround(pitches));
    for (int& blade : expected.blade_of_triangle) {
      if (blade != 0) blade = (blade - 1 + shift + kBlades) % kBlades + 1;
    }
    SCOPED_TRACE(pitches);
    expectNumbersOf(expected, findBlades(expected.mesh));
  }
}

TEST(BladeFinder, findsAnyNumberOfBlades) {
  for (const int count : {2, 3, 17}) {
    BliskOptions options;
    options.blade_count = count;
    options.target_triangles = 10'000;
    const Blisk blisk = makeBlisk(makeBladeSections({}), cylinderProfile(128.0, 100.0), options);
    EXPECT_EQ(findBlades(blisk.mesh).count, count);
  }
}

TEST(BladeFinder, findsNoneWhereThereAreNone) {
  expectNoBlades(*testing::torus(100.0, 30.0, 60, 30));
  expectNoBlades(*testing::torus(100.0, 99.0, 24, 16));
  for (const int halvings : {2, 3, 4, 5}) expectNoBlades(sphere(100.0, halvings));
  expectNoBlades(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  expectNoBlades(TriangleMesh({{0, 0, 0}}, {{0, 0, 0}}));
}

TEST(BladeFinder, findsNoneOnABarHoweverFinelyItIsCut) {
  for (const int steps : {1, 2, 10, 20, 40}) {
    expectNoBlades(block({50.0, 50.0, 20.0}, steps));
    expectNoBlades(turned(block({50.0, 50.0, 200.0}, steps), 0.3));
  }
}

TEST(BladeFinder, findsNoneWhereOneBladeIsMissing) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < blisk.mesh.triangleCount(); ++t) {
    if (blisk.blade_of_triangle[t] != 7) triangles.push_back(blisk.mesh.triangles()[t]);
  }
  expectNoBlades(TriangleMesh(blisk.mesh.vertices(), std::move(triangles)));
}

}  // namespace
}  // namespace octoblisk::demos
