#include "octoblisk/triangle_mesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "shared/message_of.h"

namespace octoblisk {
namespace {

std::string messageOf(std::vector<Vec3> vertices, std::vector<TriangleMesh::Indices> triangles) {
  return testing::messageOf([&] { TriangleMesh(std::move(vertices), std::move(triangles)); });
}

const std::vector<Vec3> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(TriangleMesh, namesWhatIsWrong) {
  EXPECT_EQ(messageOf(kCorners, {}), "the mesh has no triangles");
  EXPECT_EQ(messageOf(kCorners, {{0, 1, 2}, {0, 1, 3}}),
            "triangle 1 uses vertex 3, but the mesh has 3 vertices");
  EXPECT_EQ(messageOf({}, {{0, 0, 0}}), "triangle 0 uses vertex 0, but the mesh has 0 vertices");
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e13}) {
    std::vector<Vec3> vertices = kCorners;
    vertices[2].y() = bad;
    EXPECT_EQ(messageOf(vertices, {{0, 1, 2}}).rfind("vertex 2 has the coordinate ", 0), 0u);
  }
}

TEST(TriangleMesh, takesDegenerateTrianglesAndDuplicatePoints) {
  EXPECT_EQ(messageOf({{0, 0, 0}, {0, 0, 0}, {1e-300, 0, 0}}, {{0, 1, 2}, {0, 0, 0}}), "accepted");
}

TEST(TriangleMesh, givesBackWhatItWasMadeOf) {
  const TriangleMesh mesh(kCorners, {{2, 0, 1}});
  EXPECT_EQ(mesh.triangleCount(), 1u);
  EXPECT_EQ(mesh.triangle(0)[0], Vec3(0, 1, 0));
  EXPECT_EQ(mesh.triangle(0)[2], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.bounds().min, Vec3(0, 0, 0));
  EXPECT_EQ(mesh.bounds().max, Vec3(1, 1, 0));
}

TEST(TriangleMesh, keepsNoUnusedMemory) {
  std::vector<Vec3> vertices = kCorners;
  std::vector<TriangleMesh::Indices> triangles = {{2, 0, 1}};
  vertices.reserve(100);
  triangles.reserve(100);
  const TriangleMesh mesh(std::move(vertices), std::move(triangles));
  EXPECT_EQ(mesh.vertices().capacity(), mesh.vertices().size());
  EXPECT_EQ(mesh.triangles().capacity(), mesh.triangles().size());
}

/// Margins, tolerances and Bullet's boxes depend on the bounds.
TEST(TriangleMesh, verticesThatNoTriangleUsesAreNotInTheBounds) {
  const TriangleMesh mesh({{1e6, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1e6}}, {{1, 2, 3}});
  EXPECT_EQ(mesh.bounds().min, Vec3(0, 0, 0));
  EXPECT_EQ(mesh.bounds().max, Vec3(1, 1, 0));
}

}  // namespace
}  // namespace octoblisk
