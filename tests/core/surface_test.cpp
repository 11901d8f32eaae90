// Tests whether a mesh is closed and oriented, and its number of parts. solid_roles_test.cpp and
// defects_test.cpp test the roles of its triangles.
#include "octoblisk/surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

struct Facts {
  bool closed, oriented;
  std::size_t corners, parts;
  bool operator==(const Facts&) const = default;
};

Facts factsOf(const SharedMesh& mesh) {
  const ClusteredOctree tree = ClusteredOctree::build(mesh);
  const Surface surface(tree);
  return {surface.isClosed(), surface.isOriented(), surface.cornerCount(), surface.componentCount()};
}

/// Gives each triangle its own three vertices, like an STL file, with zeros of either sign.
SharedMesh unwelded(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : mesh.triangle(t)) {
      const double zero = t % 2 ? 0.0 : -0.0;
      vertices.push_back(corner.unaryExpr([&](double x) { return x == 0.0 ? zero : x; }));
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

SharedMesh withTriangles(const TriangleMesh& mesh, std::vector<TriangleMesh::Indices> triangles) {
  return std::make_shared<const TriangleMesh>(mesh.vertices(), std::move(triangles));
}

TEST(Surface, closedMeshes) {
  const SharedMesh box = testing::boxMesh({1, 2, 3}), ring = testing::torus(3, 1, 12, 8);
  EXPECT_EQ(factsOf(box), (Facts{true, true, 8, 1}));
  EXPECT_EQ(factsOf(ring), (Facts{true, true, 96, 1}));  // the genus is irrelevant
  EXPECT_EQ(factsOf(unwelded(*box)), (Facts{true, true, 8, 1}));
  EXPECT_EQ(factsOf(unwelded(*testing::moved(*box, {Mat3::Identity(), Vec3(1, 2, 3)}))),
            (Facts{true, true, 8, 1}));
  EXPECT_EQ(factsOf(testing::joined(*box, *ring)), (Facts{true, true, 104, 2}));
}

TEST(Surface, openAndTurnedMeshes) {
  const SharedMesh box = testing::boxMesh({1, 2, 3});
  EXPECT_EQ(factsOf(testing::firstTriangles(*box, 11)), (Facts{false, false, 8, 1}));
  EXPECT_EQ(factsOf(testing::waveSheet(4, 0.5, 4)), (Facts{false, false, 25, 1}));
  auto turned = box->triangles();
  std::swap(turned[5][0], turned[5][1]);
  EXPECT_EQ(factsOf(withTriangles(*box, turned)), (Facts{false, false, 8, 1}));  // as if it had a hole
  for (auto& triangle : turned) std::swap(triangle[1], triangle[2]);
  std::swap(turned[5][0], turned[5][1]);
  EXPECT_EQ(factsOf(withTriangles(*box, turned)), (Facts{true, true, 8, 1}));  // inside out
  turned[3][0] = turned[3][1];  // one triangle gives way to a degenerate one
  EXPECT_FALSE(factsOf(withTriangles(*box, turned)).closed);
}

TEST(Surface, degenerateTrianglesAndUnusedVerticesChangeNothing) {
  const SharedMesh box = testing::boxMesh({1, 2, 3});
  auto vertices = box->vertices();
  vertices.emplace_back(7, 7, 7);
  auto triangles = box->triangles();
  triangles.push_back({0, 0, 1});
  triangles.push_back({3, 3, 3});
  EXPECT_EQ(factsOf(std::make_shared<const TriangleMesh>(vertices, triangles)), (Facts{true, true, 8, 1}));
}

TEST(Surface, starsHoldTheTrianglesRoundACorner) {
  std::mt19937_64 random(70);
  const testing::Voxels voxels = testing::randomVoxels(random, 4);
  const ClusteredOctree tree = ClusteredOctree::build(voxels.mesh);
  const Surface surface(tree);
  EXPECT_TRUE(surface.isClosed());
  EXPECT_TRUE(surface.isOriented());
  std::size_t listed = 0;
  for (std::uint32_t corner = 0; corner < surface.cornerCount(); ++corner) {
    for (const std::uint32_t t : surface.star(corner)) {
      const Triangle triangle = voxels.mesh->triangle(t);
      EXPECT_TRUE(std::ranges::count(triangle, surface.position(corner)));
      EXPECT_TRUE(std::ranges::count(surface.corners(t), corner));
      EXPECT_EQ(surface.component(surface.corners(t)[0]), surface.component(corner));
      ++listed;
    }
  }
  EXPECT_EQ(listed, 3 * voxels.mesh->triangleCount());
  for (std::size_t component = 0; component < surface.componentCount(); ++component) {
    EXPECT_EQ(surface.component(surface.cornerOfComponent(component)), component);
  }
}

}  // namespace
}  // namespace octoblisk
