#include "geometry/connected_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "octoblisk/surface.h"
#include "shared/meshes.h"

namespace octoblisk::detail {
namespace {

/// Every triangle has its own vertices, as in an STL file.
testing::SharedMesh withoutSharedVertices(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const Vec3& corner : mesh.triangle(t)) vertices.push_back(corner);
    triangles.push_back({first, first + 1, first + 2});
  }
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

testing::SharedMesh twoOf(const TriangleMesh& mesh, const Vec3& apart) {
  std::vector<Vec3> vertices = mesh.vertices();
  std::vector<TriangleMesh::Indices> triangles(mesh.triangles().begin(), mesh.triangles().end());
  const auto count = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t v = 0; v < count; ++v) vertices.push_back(mesh.vertices()[v] + apart);
  for (const auto& [a, b, c] : mesh.triangles()) triangles.push_back({a + count, b + count, c + count});
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles));
}

TEST(ConnectedPieces, equalTheParts_vs_Surface) {
  std::mt19937_64 random(31);
  const testing::SharedMesh torus = testing::torus(3, 1, 32, 16);
  std::set<std::size_t> counts;
  for (const testing::SharedMesh& mesh :
       {torus, withoutSharedVertices(*torus), twoOf(*torus, Vec3(9, 0, 0)), twoOf(*torus, Vec3(0, 0, 0)),
        withoutSharedVertices(*twoOf(*torus, Vec3(9, 0, 0))), testing::fan(9, 10),
        testing::soup(random, 300, 5, 0.4)}) {
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    const Surface surface(tree);
    const std::vector<std::uint32_t> pieces = connectedPieces(*mesh);
    ASSERT_EQ(pieces.size(), mesh->vertices().size());
    std::vector<std::uint32_t> piece_of_part(surface.partCount());
    std::set<std::uint32_t> used;
    for (std::size_t part = 0; part < surface.partCount(); ++part) {
      const Vec3& position = surface.position(surface.cornerOfPart(part));
      const auto vertex = std::ranges::find(mesh->vertices(), position) - mesh->vertices().begin();
      piece_of_part[part] = pieces[static_cast<std::size_t>(vertex)];
      used.insert(piece_of_part[part]);
    }
    EXPECT_EQ(used.size(), surface.partCount()) << "different parts are different pieces";
    for (std::uint32_t t = 0; t < mesh->triangleCount(); ++t) {
      for (const std::uint32_t vertex : mesh->triangles()[t])
        ASSERT_EQ(pieces[vertex], piece_of_part[surface.part(surface.corners(t)[0])]);
    }
    counts.insert(surface.partCount());
  }
  EXPECT_TRUE(counts.contains(1) && counts.contains(2) && *counts.rbegin() > 100);
}

TEST(ConnectedPieces, minusZeroIsZero) {
  const TriangleMesh mesh({{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                          {{0, 1, 2}, {3, 4, 5}});
  const std::vector<std::uint32_t> pieces = connectedPieces(mesh);
  EXPECT_EQ(pieces[0], pieces[5]);
}

}  // namespace
}  // namespace octoblisk::detail
