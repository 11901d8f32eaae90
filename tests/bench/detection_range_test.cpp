#include "detection_range.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "shared/meshes.h"

namespace octoblisk::bench {

using namespace detail;

namespace {

constexpr double kRadius = 5, kTube = 1;

/// Tori far apart, each in its own pose. Each torus is a part.
struct Tori {
  explicit Tori(int count) {
    std::mt19937_64 random(92);
    const testing::SharedMesh torus = testing::torus(kRadius, kTube, 256, 64);
    for (int part = 0; part < count; ++part) {
      const Mat3 rotation = testing::randomRotation(random);
      axes.push_back(rotation.col(2));
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const Vec3& vertex : torus->vertices())
        vertices.push_back(rotation * vertex + Vec3(0, 0, 50 * part));
      for (const auto& [a, b, c] : torus->triangles()) {
        triangles.push_back({first + a, first + b, first + c});
        parts.push_back(part);
      }
    }
  }
  TriangleMesh mesh() const { return {vertices, triangles}; }

  std::vector<Vec3> vertices, axes;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<int> parts;
};

TEST(DetectionRange, ofToriIsThatOfTheirBoxes) {
  const Tori tori(4);
  const DetectionRange range = detectionRange(tori.mesh(), {.clusters = 1, .part_of_triangle = tori.parts});
  double axis_aligned = 0.0;
  for (const Vec3& axis : tori.axes) {
    const Vec3 round = (Vec3::Ones() - axis.cwiseAbs2()).cwiseSqrt();  // half of a unit circle's bounds
    axis_aligned += 8.0 * (kRadius * round + kTube * Vec3::Ones()).prod();
  }
  const double oriented = 4 * 8.0 * (kRadius + kTube) * (kRadius + kTube) * kTube;
  EXPECT_NEAR(range.axisAlignedVolume(), axis_aligned, 0.002 * axis_aligned);
  EXPECT_NEAR(range.orientedVolume(), oriented, 0.002 * oriented);
  EXPECT_LT(range.orientedVolume(), 0.7 * range.axisAlignedVolume());
}

TEST(DetectionRange, ofOneClusterIsTheBoxRoundAll) {
  const TriangleMesh mesh = Tori(3).mesh();
  const DetectionRange range = detectionRange(mesh, {.clusters = 1});
  ASSERT_EQ(range.axis_aligned.size(), 1u);
  EXPECT_EQ(range.axis_aligned[0].min, mesh.bounds().min);
  EXPECT_EQ(range.axis_aligned[0].max, mesh.bounds().max);
  EXPECT_DOUBLE_EQ(range.axisAlignedVolume(), 8.0 * mesh.bounds().halfExtents().prod());
}

TEST(DetectionRange, boxesHoldTheWholeTrianglesOfTheirClusters) {
  const testing::SharedMesh fan = testing::fan(7, 6);
  std::vector<int> parts;
  std::vector<Vec3> centroids;
  for (std::size_t t = 0; t < fan->triangleCount(); ++t) {
    parts.push_back(static_cast<int>(7 * t / fan->triangleCount()));
    const auto [a, b, c] = fan->triangle(t);
    centroids.push_back((a + b + c) / 3.0);
  }
  for (std::size_t k = 1; k <= 8; ++k) {
    const PartClusterOptions options{.clusters = k, .part_of_triangle = parts};
    const DetectionRange range = detectionRange(*fan, options);
    ASSERT_EQ(range.axis_aligned.size(), 7 * k);
    ASSERT_EQ(range.oriented.size(), 7 * k);
    std::size_t box = 0;
    for (const auto& part : partClusters(centroids, options)) {
      for (const TriangleSet& cluster : part) {
        const Aabb& bounds = range.axis_aligned[box];
        Aabb least;
        for (const std::uint32_t t : cluster) {
          for (const Vec3& corner : fan->triangle(t)) {
            least.extend(corner);
            EXPECT_TRUE(range.oriented[box].contains(corner, 1e-12));
          }
        }
        EXPECT_EQ(bounds.min, least.min);
        EXPECT_EQ(bounds.max, least.max);
        ++box;
      }
    }
  }
}

TEST(DetectionRange, shrinksWithTheBladesAndTheirClusters) {
  // More boxes enclose thin twisted blades more tightly, and oriented boxes more tightly still.
  const testing::SharedMesh fan = testing::fan(7, 16);
  std::vector<int> parts;
  for (std::size_t t = 0; t < fan->triangleCount(); ++t)
    parts.push_back(static_cast<int>(7 * t / fan->triangleCount()));
  double last = 8.0 * fan->bounds().halfExtents().prod();
  for (const std::size_t k : {1u, 2u, 4u, 8u}) {
    const DetectionRange range = detectionRange(*fan, {.clusters = k, .part_of_triangle = parts});
    EXPECT_LT(range.axisAlignedVolume(), last);
    EXPECT_LT(range.orientedVolume(), 0.7 * range.axisAlignedVolume());
    last = range.axisAlignedVolume();
  }
}

TEST(DetectionRange, refusesBadOptions) {
  const testing::SharedMesh box = testing::boxMesh({1, 2, 3});
  EXPECT_THROW(detectionRange(*box, {.part_of_triangle = {1}}), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::bench
