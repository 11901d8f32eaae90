// Compares the faces and edges of hulls with every plane through three of the points.
#include "octoblisk/hull_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "octoblisk/convex.h"
#include "shared/meshes.h"

namespace octoblisk {
namespace {

using testing::randomPoint;

/// Finds the faces as sets of coplanar points that have all other points on one side.
std::set<std::set<std::uint32_t>> facesByBruteForce(std::span<const Vec3> points) {
  std::set<std::set<std::uint32_t>> faces;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 area = (points[j] - points[i]).cross(points[k] - points[i]);
        if (area.norm() < 1e-9) continue;
        std::set<std::uint32_t> in_plane;
        bool above = false, below = false;
        for (std::uint32_t p = 0; p < points.size(); ++p) {
          const double height = area.normalized().dot(points[p] - points[i]);
          above |= height > 1e-9;
          below |= height < -1e-9;
          if (std::abs(height) <= 1e-9) in_plane.insert(p);
        }
        if (!(above && below)) faces.insert(in_plane);
      }
    }
  }
  return faces;
}

std::set<std::set<std::uint32_t>> facesOf(const HullFaces& hull, std::span<const Vec3> points) {
  std::set<std::set<std::uint32_t>> faces;
  for (const HullFace& face : hull.faces) {
    std::set<std::uint32_t> in_plane;
    for (std::uint32_t p = 0; p < points.size(); ++p) {
      const double height = face.normal.dot(points[p]) - face.offset;
      EXPECT_LE(height, 1e-9);
      if (height >= -1e-9) in_plane.insert(p);
    }
    faces.insert(in_plane);
  }
  return faces;
}

/// Checks Euler's formula, and that each edge lies in its two faces and occurs once.
void expectWellFormed(const HullFaces& hull, std::span<const Vec3> points) {
  std::set<std::uint32_t> corners;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const HullEdge& edge : hull.edges) {
    corners.insert({edge.from, edge.to});
    EXPECT_TRUE(edges.insert(std::minmax(edge.from, edge.to)).second);
    EXPECT_NE(edge.left, edge.right);
    for (const std::uint32_t f : {edge.left, edge.right}) {
      for (const std::uint32_t end : {edge.from, edge.to})
        EXPECT_NEAR(hull.faces[f].normal.dot(points[end]), hull.faces[f].offset, 1e-9);
    }
    EXPECT_NEAR(edge.cosine, hull.faces[edge.left].normal.dot(hull.faces[edge.right].normal), 1e-12);
  }
  EXPECT_EQ(corners.size() + hull.faces.size(), hull.edges.size() + 2);
}

/// A prism with corners at some angles.
std::vector<Vec3> prism(const std::vector<double>& angles) {
  std::vector<Vec3> points;
  for (const double angle : angles) {
    for (const double z : {-1.0, 1.0}) points.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  return points;
}

std::vector<Vec3> prism(int sides) {
  std::vector<double> angles;
  for (int k = 0; k < sides; ++k) angles.push_back(2.0 * std::numbers::pi * k / sides);
  return prism(angles);
}

TEST(HullFaces, ofRandomPoints_vs_bruteforce) {
  std::mt19937_64 random(51);
  HullFaceList hull;
  for (int i = 0; i < 300; ++i) {
    std::vector<Vec3> points;
    for (int p = 0; p < 4 + i % 13; ++p) {
      const Vec3 point = randomPoint(random, 1);
      points.push_back(i % 2 ? point : Vec3(point.normalized()));
    }
    hull.find(points);
    ASSERT_FALSE(hull.view().empty()) << "case " << i;
    ASSERT_EQ(facesOf(hull.view(), points), facesByBruteForce(points)) << "case " << i;
    expectWellFormed(hull.view(), points);
  }
}

TEST(HullFaces, ofPointsInOnePlaneAndOnOneLine_vs_bruteforce) {
  std::mt19937_64 random(52);
  std::vector<std::vector<Vec3>> bodies = {prism(3), prism(4), prism(12), prism(32)};
  bodies.emplace_back();  // a grid: corners, midpoints of edges and faces, and the centre
  for (int k = 0; k < 27; ++k) bodies.back().emplace_back(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (int turn = 0; turn < 5; ++turn) {
      std::vector<Vec3> points = bodies[b];
      const Mat3 rotation = turn == 0 ? Mat3(Mat3::Identity()) : testing::randomRotation(random);
      for (Vec3& point : points) point = rotation * point;
      std::shuffle(points.begin(), points.end(), random);
      HullFaceList hull;
      hull.find(points);
      ASSERT_FALSE(hull.view().empty()) << "body " << b << ", turn " << turn;
      ASSERT_EQ(facesOf(hull.view(), points), facesByBruteForce(points)) << "body " << b;
      EXPECT_EQ(hull.view().faces.size(), facesByBruteForce(points).size()) << "body " << b;
      expectWellFormed(hull.view(), points);
    }
  }
}

/// Corners at random angles make slivers, whose normals are inaccurate. They must not divide the two ends.
/// Some of these hulls are too hard to find.
TEST(HullFaces, sliversDoNotDivideAFace) {
  std::mt19937_64 random(55);
  constexpr int kCases = 400;
  int exact = 0;
  for (int i = 0; i < kCases; ++i) {
    std::vector<double> angles(static_cast<std::size_t>(3 + i % 29));
    for (double& angle : angles) angle = testing::uniform(random, 0.0, 2.0 * std::numbers::pi);
    std::vector<Vec3> points = prism(angles);
    const Mat3 rotation = testing::randomRotation(random);
    for (Vec3& point : points) point = rotation * point;
    HullFaceList hull;
    hull.find(points);
    ASSERT_LE(hull.view().faces.size(), angles.size() + 2) << "case " << i;
    exact += hull.view().faces.size() == angles.size() + 2;
  }
  EXPECT_GT(exact, kCases * 95 / 100);
}

TEST(HullFaces, ofABox) {
  std::mt19937_64 random(53);
  for (int i = 0; i < 50; ++i) {
    const ConvexBox box({randomPoint(random, 2), testing::randomRotation(random),
                         randomPoint(random, 1).cwiseAbs() + Vec3::Constant(0.1)});
    EXPECT_EQ(box.faces().faces.size(), 6u);
    EXPECT_EQ(box.faces().edges.size(), 12u);
    EXPECT_EQ(facesOf(box.faces(), box.points()), facesByBruteForce(box.points()));
    expectWellFormed(box.faces(), box.points());
    for (int d = 0; d < 20; ++d) {
      const Vec3 direction = randomPoint(random, 1);
      EXPECT_NEAR(box.support(direction).dot(direction), farthest(box.points(), direction).dot(direction),
                  1e-12);
    }
  }
}

TEST(HullFaces, noneOfFlatOrManyPoints) {
  std::mt19937_64 random(54);
  HullFaceList hull;
  std::vector<Vec3> flat, line, many;
  for (int p = 0; p < 20; ++p) {
    const Vec3 point = randomPoint(random, 1);
    flat.emplace_back(point.x(), point.y(), 0.3);
    line.push_back(point.x() * Vec3(1, 2, 3));
  }
  for (int p = 0; p < 65; ++p) many.push_back(randomPoint(random, 1).normalized());
  for (const auto& points : {flat, line, many, std::vector<Vec3>(9, Vec3(1, 2, 3)), std::vector<Vec3>()}) {
    hull.find(points);
    EXPECT_TRUE(hull.view().empty());
    EXPECT_TRUE(hull.view().edges.empty());
  }
  many.pop_back();
  hull.find(many);
  EXPECT_EQ(hull.view().faces.size(), 2u * 64 - 4);
}

}  // namespace
}  // namespace octoblisk
