// Compares the closest point of a mesh with a brute-force search over every triangle.
#include "octoblisk/closest_point.h"

#include <gtest/gtest.h>

#include <array>

#include "shared/hard_meshes.h"
#include "shared/solids.h"

namespace octoblisk {
namespace {

using testing::SharedMesh;

TEST(ClosestPoint, triangle_vs_leastSquares) {
  std::mt19937_64 random(71);
  for (int i = 0; i < 20'000; ++i) {
    Triangle triangle = testing::randomTriangle(random, 1.0);
    if (i % 10 == 1) triangle[2] = triangle[0] + 1e-6 * (triangle[2] - triangle[0]);
    if (i % 10 == 2) triangle[2] = 0.3 * triangle[0] + 0.7 * triangle[1] + 1e-5 * triangle[2];
    const Vec3 point = testing::randomPoint(random, i % 3 == 0 ? 20.0 : 1.0);
    const Vec3 closest = closestPoint(triangle, point);
    ASSERT_NEAR((closest - point).norm(), testing::bruteForceDistance(triangle, point),
                1e-9 * (1.0 + point.norm()));
    ASSERT_LT(testing::bruteForceDistance(triangle, closest), 1e-9 * (1.0 + point.norm())) << i;
  }
}

TEST(ClosestPoint, degenerateTriangles) {
  const Vec3 a(0, 0, 0), b(2, 0, 0), middle(1, 0, 0);
  for (const Triangle& triangle : {Triangle{a, b, middle}, Triangle{a, a, b}, Triangle{b, a, b}}) {
    EXPECT_EQ(closestPoint(triangle, Vec3(0.5, 3, 0)), Vec3(0.5, 0, 0));
    EXPECT_EQ(closestPoint(triangle, Vec3(-1, 3, 0)), a);
    EXPECT_EQ(closestPoint(triangle, Vec3(5, 3, 1)), b);
  }
  EXPECT_EQ(closestPoint(Triangle{b, b, b}, Vec3(5, 3, 1)), b);
}

TEST(ClosestPoint, tree_vs_bruteforce) {
  std::mt19937_64 random(72);
  const Pose far{testing::randomRotation(random), Vec3(1e6, -2e6, 3e6)};
  const SharedMesh ring = testing::torus(3, 1, 24, 16);
  struct Scene {
    SharedMesh mesh;
    Vec3 center;
    double size, reach;
  };
  const std::vector<Scene> scenes = {{ring, Vec3::Zero(), 4.0, 0.8},
                                     {testing::fan(7, 8), Vec3::Zero(), 2.0, 0.5},
                                     {testing::soup(random, 400, 5, 0.4), Vec3::Zero(), 6.0, 0.8},
                                     {testing::moved(*ring, far), far.translation, 4.0, 0.8},
                                     {testing::moved(*ring, Pose{}, 1e-12), Vec3::Zero(), 4e-12, 0.8e-12},
                                     {testing::moved(*ring, Pose{}, 1e11), Vec3::Zero(), 4e11, 0.8e11},
                                     {testing::boxMesh({1, 0, 2}), Vec3::Zero(), 2.0, 0.8}};
  for (const PartitionKind kind : {PartitionKind::clustering, PartitionKind::paper}) {
    for (std::size_t s = 0; s < scenes.size(); ++s) {
      const Scene& scene = scenes[s];
      const ClusteredOctree tree = ClusteredOctree::build(scene.mesh, {.partition = kind});
      int within = 0;
      constexpr int kPoints = 200;
      for (int i = 0; i < kPoints; ++i) {
        const Vec3 point =
            scene.center + testing::randomPoint(random, (i % 9 == 0 ? 30.0 : 0.9) * scene.size);
        const double expected = testing::bruteForceDistance(*scene.mesh, point);
        const double rounding = 1e-12 * (scene.size + expected) + 1e-15 * scene.center.norm();
        const auto found = closestPoint(tree, point);
        ASSERT_TRUE(found) << "scene " << s;
        ASSERT_NEAR(found->distance, expected, rounding) << "scene " << s << ", point " << i;
        ASSERT_EQ(found->distance, (found->point - point).norm());
        ASSERT_LE(testing::bruteForceDistance(scene.mesh->triangle(found->triangle), found->point), rounding);
        // The point is found with a bound equal to its distance, but not with one just below it.
        ASSERT_TRUE(closestPoint(tree, point, found->distance));
        ASSERT_EQ(closestPoint(tree, point, found->distance)->triangle, found->triangle);
        ASSERT_FALSE(closestPoint(tree, point, std::nextafter(found->distance, 0.0)));
        const double bound = scene.reach;
        const auto bounded = closestPoint(tree, point, bound);
        ASSERT_EQ(bounded.has_value(), found->distance <= bound);
        within += bounded.has_value();
      }
      EXPECT_GE(within, kPoints * 2 / 10) << "scene " << s;
      EXPECT_LE(within, kPoints * 7 / 10) << "scene " << s;
    }
  }
}

/// The closest point of the first of the nearest triangles. Counts the points with several nearest triangles.
ClosestPoint ofEveryTriangle(const TriangleMesh& mesh, const Vec3& point, int& ties) {
  ClosestPoint nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  bool is_tie = false;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const Vec3 on_triangle = closestPoint(mesh.triangle(t), point);
    const double distance = std::sqrt((on_triangle - point).squaredNorm());
    if (distance > nearest.distance) continue;
    is_tie = distance == nearest.distance;
    if (!is_tie) nearest = {on_triangle, distance, t};
  }
  ties += is_tie;
  return nearest;
}

/// The tree gives the same answer as a test of every triangle, to the last bit. Of equally near triangles it
/// names the first.
TEST(ClosestPoint, hardMeshes_vs_bruteforce) {
  std::mt19937_64 random(73);
  int ties = 0;
  constexpr std::array<double, 4> kScales = {1.0, 1.0, 1e-6, 1e-30};
  for (int k = 0; k < 4 * testing::kMeshKinds; ++k) {
    const auto kind = static_cast<testing::MeshKind>(k / 4);
    const double scale = kScales[static_cast<std::size_t>(k % 4)];
    const bool is_tiny = scale == 1e-30;  // squares of distances are subnormal in single precision
    const Vec3 offset = k % 4 == 1 ? Vec3(1e3, -2e3, 3e3) : Vec3::Zero();
    const SharedMesh mesh = testing::scaledAndMoved(testing::hardMesh(random, kind), scale, offset);
    const ClusteredOctree full = ClusteredOctree::build(mesh);
    const ClusteredOctree compact = ClusteredOctree::build(mesh, {.storage = Storage::compact});
    for (int i = 0; i < 300; ++i) {
      const Triangle start = mesh->triangle(random() % mesh->triangleCount());
      const double away = scale * std::pow(10.0, is_tiny ? 7 + i % 4 : 2 - i % 10);
      const Vec3 point =
          (i / 10 % 2 == 0 ? start[0] : centroidOf(start)) + testing::randomPoint(random, away);
      const ClosestPoint expected = ofEveryTriangle(*mesh, point, ties);
      for (const ClusteredOctree* tree : {&full, &compact}) {
        const auto found = closestPoint(*tree, point);
        ASSERT_TRUE(found);
        ASSERT_EQ(found->triangle, expected.triangle) << testing::nameOf(kind) << ", point " << i;
        ASSERT_EQ(found->distance, expected.distance);
      }
    }
  }
  EXPECT_GE(ties, 500);
}

/// Far from the origin, a distance is known to a unit in the last place of the coordinates.
TEST(ClosestPoint, stackedTrianglesFarFromTheOrigin) {
  constexpr std::uint32_t kTriangles = 40;  // in several leaves
  std::mt19937_64 random(75);
  const auto within = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  int ties = 0;
  for (int k = 0; k < 400; ++k) {
    const double gap = std::pow(10.0, -6 + k % 4);
    const Vec3 offset(within(9e11), within(9e11), within(9e11));
    const auto above = [&](double x, double y, double up) {
      return Vec3(offset + Vec3(x, y, 0.3 * x + 0.2 * y + up));
    };
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> triangles;
    for (std::uint32_t t = 0; t < kTriangles; ++t) {
      const double up = within(gap);
      vertices.push_back(above(1.0 + within(0.2), within(0.2), up));
      vertices.push_back(above(-0.5 + within(0.2), 0.9 + within(0.2), up));
      vertices.push_back(above(-0.5 + within(0.2), -0.9 + within(0.2), up));
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    const auto mesh = std::make_shared<const TriangleMesh>(vertices, triangles);
    const ClusteredOctree tree = ClusteredOctree::build(mesh);
    for (int i = 0; i < 40; ++i) {
      const Vec3 point = above(within(0.2), within(0.2), within(i % 2 == 0 ? 2 * gap : 0.3));
      const ClosestPoint expected = ofEveryTriangle(*mesh, point, ties);
      const auto found = closestPoint(tree, point);
      ASSERT_TRUE(found);
      ASSERT_EQ(found->triangle, expected.triangle) << "stack " << k << ", point " << i;
      ASSERT_EQ(found->distance, expected.distance);
    }
  }
  EXPECT_GE(ties, 1000);
}

/// The edges of a thin triangle are farther from a point over its middle than a wide triangle just behind it.
TEST(ClosestPoint, thinTrianglesInFrontOfAWideOne) {
  std::mt19937_64 random(74);
  for (int i = 0; i < 2'000; ++i) {
    const double width = std::exp2(-4.0 - 0.004 * i), height = 0.02 * width;
    const Pose pose = testing::randomPose(random, 3.0);
    std::vector<Vec3> vertices = {{-2, -2, -height},     {2, -2, -height},     {0, 3, -height},
                                  {-0.5, -width / 3, 0}, {0.5, -width / 3, 0}, {0.0, 2 * width / 3, 0}};
    for (Vec3& vertex : vertices) vertex = pose * vertex;
    std::vector<TriangleMesh::Indices> triangles = {{0, 1, 2}, {3, 4, 5}};
    const std::uint32_t thin = i % 2 == 0;
    if (thin == 0) std::swap(triangles[0], triangles[1]);
    const auto tree = ClusteredOctree::build(std::make_shared<const TriangleMesh>(vertices, triangles));
    const auto found = closestPoint(tree, pose * Vec3(0, 0, 0.5 * height));
    ASSERT_TRUE(found);
    ASSERT_EQ(found->triangle, thin) << width;
    ASSERT_NEAR(found->distance, 0.5 * height, 1e-10);
  }
}

}  // namespace
}  // namespace octoblisk
