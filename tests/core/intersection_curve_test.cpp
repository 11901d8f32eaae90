// Tests the way out that the curve determines in which two surfaces meet.
#include "geometry/intersection_curve.h"

#include <gtest/gtest.h>

#include <vector>

#include "shared/block.h"
#include "shared/meshes.h"
#include "shared/solids.h"

namespace octoblisk {

using namespace detail;

namespace {

using testing::uniform;

std::vector<CurveSegment> curveOf(const TriangleMesh& a, const TriangleMesh& b, const Pose& pose,
                                  const Vec3& shift) {
  std::vector<CurveSegment> curve;
  for (std::size_t i = 0; i < a.triangleCount(); ++i) {
    for (std::size_t j = 0; j < b.triangleCount(); ++j) {
      Triangle of_b = b.triangle(j);
      for (Vec3& corner : of_b) corner += shift;
      if (const auto segment = meetingSegment(pose * a.triangle(i), pose * of_b)) curve.push_back(*segment);
    }
  }
  return curve;
}

/// The volume in which two boxes with parallel axes overlap is a product, so its gradient is a closed form.
TEST(IntersectionCurve, wayOutOfBoxesIsTheGradientOfTheOverlap) {
  std::mt19937_64 random(101);
  int across = 0;
  constexpr int kCases = 200;
  for (int i = 0; i < kCases; ++i) {
    const auto sizes = [&] {
      return Vec3(uniform(random, 0.5, 2), uniform(random, 0.5, 2), uniform(random, 0.5, 2));
    };
    const Vec3 half_a = sizes(), half_b = sizes();
    Vec3 shift, overlap, grows;  // when A moves along +k: 1, or -1, or 0 if one box reaches across the other
    for (int k = 0; k < 3; ++k) {
      shift[k] = uniform(random, -1, 1) * (half_a[k] + half_b[k]) * 0.9;
      const double low = std::max(-half_a[k], shift[k] - half_b[k]),
                   high = std::min(half_a[k], shift[k] + half_b[k]);
      overlap[k] = high - low;
      grows[k] = (high == half_a[k] ? 1.0 : 0.0) - (low == -half_a[k] ? 1.0 : 0.0);
    }
    const Vec3 gradient(grows[0] * overlap[1] * overlap[2], grows[1] * overlap[2] * overlap[0],
                        grows[2] * overlap[0] * overlap[1]);
    const Pose pose = testing::randomPose(random, 5.0);
    const std::optional<Vec3> out =
        wayOut(curveOf(testing::block(half_a, 3), testing::block(half_b, 4), pose, shift));
    if (gradient.norm() < 0.3 * std::cbrt(overlap.prod() * overlap.prod())) continue;
    ASSERT_TRUE(out) << i;
    EXPECT_LT((*out + pose.rotation * gradient.normalized()).norm(), 1e-9) << i;
    across += grows.isZero(0.0) ? 0 : (grows.array() == 0.0).any();
  }
  EXPECT_GT(across, kCases / 3);
}

/// Where bars cross, the curve is on the upper side of one and on the lower side of the other.
TEST(IntersectionCurve, extendsAsFarAsBarsThatCrossAreDeep) {
  std::mt19937_64 random(103);
  for (int i = 0; i < 50; ++i) {
    const double overlap = uniform(random, 0.01, 0.3);
    const Pose pose = testing::randomPose(random, 5.0);
    const std::vector<CurveSegment> curve =
        curveOf(testing::block({1, 0.2, 0.2}, 5), testing::block({0.15, 1, 0.2}, 6), pose,
                Vec3(0.05, 0.03, 0.4 - overlap));
    const std::optional<Vec3> out = wayOut(curve);
    ASSERT_TRUE(out) << i;
    EXPECT_NEAR(extentAlong(*out, curve), overlap, 1e-9) << i;
    EXPECT_NEAR(depthAlong(*out, curve), overlap, 1e-9) << i;
    EXPECT_LT((middleOf(curve) - pose * Vec3(0.05, 0.0, 0.2 - 0.5 * overlap)).norm(), 0.06) << i;
  }
}

/// Faces along the way out do not bound the overlap, wherever the middle of the curve is.
TEST(IntersectionCurve, legsOfATableCrossASlab) {
  std::mt19937_64 random(105);
  const auto slab = testing::block({2, 2, 0.5}, 1);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = testing::randomPose(random, 5.0);
    std::vector<CurveSegment> curve;
    for (const double x : {-0.5, 0.6}) {
      for (const double y : {-0.7, 0.4}) {
        const std::vector<CurveSegment> of_leg =
            curveOf(testing::block({0.1, 0.12, 0.4}, 2), slab, pose, Vec3(x, y, -0.8));
        curve.insert(curve.end(), of_leg.begin(), of_leg.end());
      }
    }
    const std::optional<Vec3> out = wayOut(curve);
    ASSERT_TRUE(out) << i;
    EXPECT_LT((*out - pose.rotation * Vec3::UnitZ()).norm(), 1e-9) << i;
    EXPECT_LT(extentAlong(*out, curve), 1e-9) << i;
    EXPECT_GT(depthAlong(*out, curve), 0.0) << i;
  }
}

/// The walls of a cup in a cup lie along each other: the curve is as high as the walls, the overlap shallow.
TEST(IntersectionCurve, nestedWallsOverlapLessThanTheCurveExtends) {
  const auto cup = testing::cup(0.03, 0.05, 0.1, 0.008, 24);
  std::mt19937_64 random(104);
  int ways_out = 0;
  for (int i = 0; i < 50; ++i) {
    const Vec3 shift(uniform(random, 0.001, 0.002), 0.0, uniform(random, 0.034, 0.04));
    const std::vector<CurveSegment> curve = curveOf(*cup, *cup, {}, shift);
    const std::optional<Vec3> out = wayOut(curve);
    if (!out) continue;
    ++ways_out;
    EXPECT_GT(extentAlong(*out, curve), 0.02) << i;
    EXPECT_LT(depthAlong(*out, curve), 0.1 * extentAlong(*out, curve)) << i;
  }
  EXPECT_GT(ways_out, 25);
}

TEST(IntersectionCurve, aBoxOnARodHasNoWayOut) {
  EXPECT_FALSE(wayOut(
      curveOf(testing::block({0.1, 0.12, 2}, 3), testing::block({1, 1, 1}, 4), {}, Vec3(0.01, 0.02, 0.03))));
}

TEST(IntersectionCurve, anOpenCurveHasNoWayOut) {
  const TriangleMesh sheet = *testing::waveSheet(0.5, 0.0, 4);
  EXPECT_FALSE(wayOut(curveOf(sheet, testing::block({0.3, 0.2, 0.1}, 3), {}, Vec3(0.45, 0.02, 0.03))));
  EXPECT_TRUE(wayOut(curveOf(sheet, testing::block({0.3, 0.2, 0.1}, 3), {}, Vec3(0.05, 0.02, 0.03))));
}

}  // namespace
}  // namespace octoblisk
