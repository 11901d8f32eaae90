#include "geometry/triangle_pair.h"

#include <gtest/gtest.h>

#include "geometry/triangle_convex.h"
#include "shared/brute_force.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::randomPoint;
using testing::randomTriangle;
using testing::uniform;

Triangle integerTriangle(std::mt19937_64& random, double half_size) {
  Triangle t = randomTriangle(random, half_size);
  for (Vec3& corner : t) corner = corner.array().round();
  return t;
}

TEST(TrianglePair, verdictEqualsIntegersOnDegenerateNeighbours) {
  std::mt19937_64 random(12);
  int hits = 0;
  constexpr int kCases = 200'000;
  for (int i = 0; i < kCases; ++i) {
    // Few distinct coordinates give many shared vertices, coplanar pairs, crossing edges, segments and
    // points.
    const double size = i % 3 == 0 ? 1.6 : i % 3 == 1 ? 4.0 : 500.0;
    Triangle a = integerTriangle(random, size), b = integerTriangle(random, size);
    if (i % 5 == 0) {
      for (Vec3& corner : b) corner.z() = a[0].z();
      for (Vec3& corner : a) corner.z() = a[0].z();
    }
    const bool expected = testing::integerTrianglesMeet(a, b);
    hits += expected;
    ASSERT_EQ(intersects(a, b), expected) << "case " << i;
    ASSERT_EQ(intersects(b, a), expected) << "case " << i;
    ASSERT_EQ(intersects({a[1], a[0], a[2]}, {b[2], b[1], b[0]}), expected) << "case " << i;
  }
  EXPECT_GT(hits, kCases * 3 / 10);
  EXPECT_LT(hits, kCases * 7 / 10);
}

TEST(TrianglePair, touchingAtAVertexAnEdgeAndInAPlane) {
  const Triangle a = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_TRUE(intersects(a, {Vec3(1, 1, 0), Vec3(1, 1, 3), Vec3(2, 1, 3)}));      // a vertex on the face
  EXPECT_TRUE(intersects(a, {Vec3(2, -1, 1), Vec3(2, 1, -1), Vec3(2, -9, -9)}));  // edge on edge
  EXPECT_TRUE(intersects(a, {Vec3(1, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1.5, 0)}));  // inside, coplanar
  EXPECT_TRUE(intersects(a, {Vec3(4, 0, 0), Vec3(8, 0, 0), Vec3(8, 4, 0)}));      // a shared vertex, coplanar
  EXPECT_FALSE(intersects(a, {Vec3(4.000001, 0, 0), Vec3(8, 0, 0), Vec3(8, 4, 0)}));
  EXPECT_FALSE(intersects(a, {Vec3(1, 1, 1e-300), Vec3(1, 1, 3), Vec3(2, 1, 3)}));
}

TEST(TrianglePair, distanceOfClosestPointsEqualsGjk) {
  std::mt19937_64 random(13);
  int apart = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Triangle a = randomTriangle(random, 1);
    Triangle b = randomTriangle(random, 1);
    const Vec3 offset = randomPoint(random, 1.5);
    for (Vec3& corner : b) corner += offset;
    if (i % 4 == 0) b[2] = b[1];
    if (intersects(a, b)) continue;
    ++apart;
    const Contact contact = closestPoints(a, b);
    const auto expected = contactOf(a, ConvexHull({b[0], b[1], b[2]}), 100.0);
    ASSERT_TRUE(expected);
    ASSERT_NEAR(contact.distance, expected->distance, 1e-9) << "case " << i;
    ASSERT_NEAR((contact.point_on_a - contact.point_on_b).norm(), contact.distance, 1e-12);
    ASSERT_TRUE((contact.point_on_b + contact.distance * contact.normal).isApprox(contact.point_on_a, 1e-9));
  }
  EXPECT_GT(apart, 5'000);
}

TEST(TrianglePair, closestPointsOfParallelEdges) {
  const Triangle a = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, -1, 0)};
  const Triangle b = {Vec3(5, 3, 0), Vec3(9, 3, 0), Vec3(7, 5, 0)};
  EXPECT_NEAR(closestPoints(a, b).distance, std::sqrt(10.0), 1e-15);
}

TEST(TrianglePair, depthIsTheLeastTranslationAlongAFaceThatParts) {
  std::mt19937_64 random(14);
  int meeting = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Triangle a = randomTriangle(random, 1), b = randomTriangle(random, 1);
    if (!intersects(a, b)) continue;
    ++meeting;
    const Contact contact = contactOf(a, b);
    ASSERT_LE(contact.distance, 0.0);
    const Vec3 normal_a = unitNormal(a), normal_b = unitNormal(b);
    ASSERT_TRUE(contact.normal.isApprox(-normal_a, 1e-9) || contact.normal.isApprox(normal_b, 1e-9));
    ASSERT_NEAR((contact.point_on_a - contact.point_on_b).norm(), -contact.distance, 1e-12);
    const auto moved = [&](double factor) {
      return Pose{Mat3::Identity(), -contact.distance * factor * contact.normal} * a;
    };
    ASSERT_FALSE(intersects(moved(1.0 + 1e-6), b)) << "case " << i;
    ASSERT_TRUE(intersects(moved(1.0 - 1e-6), b)) << "case " << i;
    // No shorter translation along the other face's normal separates them.
    const Vec3 other = contact.normal.isApprox(normal_b, 1e-9) ? Vec3(-normal_a) : normal_b;
    const Pose along_other{Mat3::Identity(), -contact.distance * (1.0 - 1e-6) * other};
    ASSERT_TRUE(intersects(along_other * a, b)) << "case " << i;
  }
  EXPECT_GT(meeting, 2'000);
}

TEST(TrianglePair, degenerateTrianglesThatMeetTouch) {
  const Triangle point = {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)};
  const Triangle segment = {Vec3(0, 0, 0), Vec3(2, 2, 2), Vec3(1, 1, 1)};
  EXPECT_TRUE(intersects(point, segment));
  const Contact contact = contactOf(point, segment);
  EXPECT_EQ(contact.distance, 0.0);
  EXPECT_NEAR(contact.normal.norm(), 1.0, 1e-12);
}

TEST(TrianglePair, needlesThatMeetShareAPoint) {
  constexpr double kWidth = 0x1.d3d343d3d3d3ep-44;  // of a length of about 10
  const Triangle a = {Vec3(10, kWidth, kWidth), Vec3(0, kWidth, 0), Vec3(kWidth, 5e-324, 1e-323)};
  const Triangle b = {Vec3(1e-323, kWidth, kWidth), Vec3(10, 1.5e-323, 5e-324),
                      Vec3(kWidth, 2e-323, 0x1.d3d343d3d3d3fp-44)};
  ASSERT_TRUE(intersects(a, b));
  const Contact contact = contactOf(a, b);
  EXPECT_EQ(contact.distance, 0.0);
  EXPECT_EQ(contact.point_on_a, contact.point_on_b);
}

}  // namespace
}  // namespace octoblisk
