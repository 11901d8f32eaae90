#include <gtest/gtest.h>

#include "build/paper/principal_box.h"
#include "geometry/bounding_box.h"
#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

TEST(Obb, covarianceOfKnownPoints) {
  const std::vector<Vec3> points = {{1, 2, 0}, {3, 2, 0}, {2, 5, 0}};  // by hand, with n − 1 = 2
  Mat3 expected;
  expected << 1, 0, 0, 0, 3, 0, 0, 0, 0;
  EXPECT_TRUE(covariance(points).isApprox(expected, 1e-14));
  EXPECT_TRUE(covariance(std::vector<Vec3>{{7, 8, 9}}).isZero());
}

TEST(Obb, findsTheFrameOfATurnedBox) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 100; ++i) {
    const Pose pose = testing::randomPose(random, 10);
    const Vec3 half(3.0, 2.0, 1.0);
    const testing::SharedMesh mesh = testing::boxMesh(half);
    std::vector<Vec3> corners;
    for (const Vec3& corner : mesh->vertices()) corners.push_back(pose * corner);
    const Obb box = principalBox(corners);
    EXPECT_TRUE(box.center.isApprox(pose.translation, 1e-12));
    EXPECT_TRUE(box.half_extents.isApprox(half, 1e-12)) << box.half_extents.transpose();
    EXPECT_TRUE((box.axes.transpose() * pose.rotation).cwiseAbs().isIdentity(1e-9));
    EXPECT_NEAR(box.axes.determinant(), 1.0, 1e-12);
  }
}

TEST(Obb, centreIsTheMiddleOfTheBoxNotTheCentroid) {
  const std::vector<Vec3> points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {10, 0, 0}};
  EXPECT_TRUE(principalBox(points).center.isApprox(Vec3(5, 0, 0)));
}

TEST(Obb, holdsItsPointsWhateverTheirSpread) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    std::vector<Vec3> points;
    const Vec3 spread(1.0, i % 3 ? 1e-3 : 0.0, i % 2 ? 1e-9 : 0.0);  // solid, flat and collinear clouds
    const Pose pose = testing::randomPose(random, 100);
    for (int p = 0; p <= i % 7; ++p)
      points.push_back(pose * testing::randomPoint(random, 1).cwiseProduct(spread));
    const Obb box = principalBox(points);
    for (const Vec3& point : points) EXPECT_TRUE(box.contains(point, 1e-12));
    EXPECT_TRUE((box.axes.transpose() * box.axes).isIdentity(1e-12));
  }
}

TEST(Obb, refusesNoPoints) {
  EXPECT_THROW(principalBox({}), std::invalid_argument);
  EXPECT_THROW(boundingBox({}, Mat3::Identity()), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk
