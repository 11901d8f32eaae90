#include "render/display_mesh.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "demos/block.h"
#include "models/blisk.h"

namespace octoblisk::demos {
namespace {

/// A square sheet of n × n squares of side 1 in the plane z = height, facing up or down.
void addSheet(std::size_t n, double height, bool up, std::vector<Vec3>& vertices,
              std::vector<TriangleMesh::Indices>& triangles) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  const auto row = static_cast<std::uint32_t>(n + 1);
  for (std::size_t y = 0; y <= n; ++y) {
    for (std::size_t x = 0; x <= n; ++x) {
      vertices.emplace_back(static_cast<double>(x), static_cast<double>(y), height);
    }
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = first + y * row + x;
      TriangleMesh::Indices one = {a, a + 1, a + row + 1}, other = {a, a + row + 1, a + row};
      if (!up) {
        std::swap(one[1], one[2]);
        std::swap(other[1], other[2]);
      }
      triangles.push_back(one);
      triangles.push_back(other);
    }
  }
}

double areaOf(const DisplayMesh& mesh) {
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += 0.5 * scaledNormal({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}).norm();
  }
  return area;
}

TEST(DisplayMesh, isTheMeshItselfByGroupsWhereThatIsSmallEnough) {
  const TriangleMesh mesh = block(Vec3(0.5, 1.0, 1.5), 2);
  std::vector<int> groups;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) groups.push_back(t % 2 == 0 ? 7 : 3);
  const DisplayMesh drawn = displayMeshOf(mesh, groups, mesh.triangleCount());
  EXPECT_FALSE(drawn.is_simplified);
  ASSERT_EQ(drawn.triangles.size(), mesh.triangleCount());
  ASSERT_EQ(drawn.groups.size(), 2u);
  EXPECT_EQ(drawn.groups[0].number, 3);
  EXPECT_EQ(drawn.groups[1].number, 7);
  EXPECT_EQ(drawn.groups[0].count + drawn.groups[1].count, mesh.triangleCount());
  EXPECT_EQ(drawn.groups[1].first, drawn.groups[0].count);
  // The triangles of group 3 are the odd ones, in their order.
  for (std::size_t i = 0; i < drawn.groups[0].count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(drawn.vertices[drawn.triangles[i][k]], mesh.triangle(2 * i + 1)[k]);
    }
  }
  EXPECT_THROW(displayMeshOf(mesh, std::vector<int>(3), 100), std::invalid_argument);
  EXPECT_THROW(displayMeshOf(mesh, {}, 0), std::invalid_argument);
}

TEST(DisplayMesh, thinnedSheetsKeepTheirPlanesAndStayApart) {
  // Two sheets near each other, back to back as the sides of a blade.
  constexpr std::size_t kSide = 60;
  constexpr double kThick = 0.25;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  addSheet(kSide, kThick, true, vertices, triangles);
  addSheet(kSide, 0.0, false, vertices, triangles);
  const TriangleMesh mesh(vertices, triangles);
  const std::size_t most = mesh.triangleCount() / 6;
  const DisplayMesh drawn = displayMeshOf(mesh, {}, most);
  EXPECT_LE(drawn.triangles.size(), most);
  EXPECT_GT(drawn.triangles.size(), most / 3);
  EXPECT_TRUE(drawn.is_simplified);
  EXPECT_LT(drawn.error, 1e-3) << "planes lose nothing";
  std::size_t above = 0;
  double facing = 0.0;  // area
  for (const auto& [a, b, c] : drawn.triangles) {
    const Triangle corners = {drawn.vertices[a], drawn.vertices[b], drawn.vertices[c]};
    // No triangle joins the sheets.
    ASSERT_EQ(corners[0].z(), corners[1].z());
    ASSERT_EQ(corners[0].z(), corners[2].z());
    const bool is_above = corners[0].z() == kThick;
    above += is_above;
    facing += 0.5 * scaledNormal(corners).z() * (is_above ? 1.0 : -1.0);
  }
  EXPECT_GT(above, drawn.triangles.size() / 3);
  EXPECT_LT(above, drawn.triangles.size() * 2 / 3);
  const double whole = 2.0 * kSide * kSide;
  EXPECT_NEAR(facing, whole, 1e-9 * whole) << "each sheet faces as it did, within its rim";
  EXPECT_LE(areaOf(drawn), 1.02 * whole);
}

TEST(DisplayMesh, thinnedBliskHasItsBladesAndItsOwnVertices) {
  const Blisk blisk = makeDefaultBlisk(10'000);
  const DisplayMesh drawn = displayMeshOf(blisk.mesh, blisk.blade_of_triangle, 3'000);
  EXPECT_LE(drawn.triangles.size(), 3'000u);
  EXPECT_GT(drawn.triangles.size(), 1'000u);
  ASSERT_EQ(drawn.groups.size(), 25u);  // hub and blades
  std::set<std::array<double, 3>> whole;
  for (const Vec3& v : blisk.mesh.vertices()) whole.insert({v.x(), v.y(), v.z()});
  for (const Vec3& v : drawn.vertices) EXPECT_TRUE(whole.contains({v.x(), v.y(), v.z()}));
}

}  // namespace
}  // namespace octoblisk::demos
