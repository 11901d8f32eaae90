#include "query/triangle_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "octoblisk/convex.h"
#include "shared/meshes.h"

namespace octoblisk::detail {
namespace {

constexpr double kTolerance = 1e-9;
const Triangle kFloor{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)};

Pose at(const Vec3& translation) { return {Mat3::Identity(), translation}; }

TEST(TriangleSweep, aBallMeetsAFace_vs_closedForm) {
  const ConvexHull ball({Vec3::Zero()}, 0.25);
  std::mt19937_64 random(11);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from(0, 0, testing::uniform(random, 0.3, 2.0)),
        to = from + testing::uniform(random, 0.1, 3.0) * testing::randomPoint(random, 1.0);
    const double distance = testing::uniform(random, -0.2, 0.2);
    const auto impact = sweep(kFloor, ball, Motion(at(from), at(to)), distance, kTolerance, 1.0);
    const double expected =
        from.z() < 0.25 + distance ? 0.0 : (from.z() - 0.25 - distance) / (from.z() - to.z());
    const bool hits = from.z() < 0.25 + distance || (expected > 0.0 && expected < 1.0);
    ASSERT_EQ(impact.has_value(), hits) << i;
    if (!hits) continue;
    EXPECT_NEAR(impact->fraction, expected, 1e-7);
    EXPECT_LT((impact->contact.normal + Vec3::UnitZ()).norm(), 1e-9);
  }
}

/// A ball flies past an edge at this distance.
TEST(TriangleSweep, aGrazingBall_vs_closedForm) {
  const ConvexHull ball({Vec3::Zero()}, 0.25);
  for (const double gap : {-0.1, -1e-3, -1e-6, 1e-6, 1e-3, 0.1}) {
    const double y = -9.0 - 0.25 - gap;
    const auto impact =
        sweep(kFloor, ball, Motion(at(Vec3(0, y, 3)), at(Vec3(0, y, -5))), 0.0, kTolerance, 1.0);
    ASSERT_EQ(impact.has_value(), gap < 0.0) << gap;
    if (!impact) continue;
    EXPECT_NEAR(3.0 - 8.0 * impact->fraction, std::sqrt(0.0625 - std::pow(0.25 + gap, 2)), 1e-4);
  }
}

/// A needle that turns about its end comes down on the face.
TEST(TriangleSweep, aTurningNeedle_vs_closedForm) {
  const ConvexHull needle({Vec3::Zero(), Vec3::UnitX()});
  const double quarter = std::numbers::pi / 2.0;
  for (const double height : {0.2, 0.5, 0.9}) {
    const Mat3 turn = Eigen::AngleAxisd(quarter, Vec3::UnitY()).toRotationMatrix();
    const auto impact = sweep(kFloor, needle, Motion(at(Vec3(0, 0, height)), {turn, Vec3(0, 0, height)}), 0.0,
                              kTolerance, 1.0);
    ASSERT_TRUE(impact);
    EXPECT_NEAR(impact->fraction, std::asin(height) / quarter, 1e-6);
  }
}

TEST(TriangleSweep, slidingAndRest) {
  const ConvexHull ball({Vec3::Zero()}, 0.25);
  const auto impact = [&](double height, const Vec3& way) {
    const Vec3 from(0, 0, 0.25 + height);
    return sweep(kFloor, ball, Motion(at(from), at(from + way)), 0.0, kTolerance, 1.0).has_value();
  };
  for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(0, 0, -1)})
    EXPECT_TRUE(impact(-1e-3, way));
  EXPECT_FALSE(impact(0, Vec3(1, 0, 0)));
  EXPECT_FALSE(impact(0, Vec3(0, 0, 1)));
  EXPECT_TRUE(impact(0, Vec3(0, 0, 0)));
  EXPECT_TRUE(impact(0, Vec3(1, 0, -1)));
  // Onto the face from beside it, and over its edge.
  EXPECT_FALSE(
      sweep(kFloor, ball, Motion(at(Vec3(0, -10, 0.25)), at(Vec3(0, 0, 0.25))), 0.0, kTolerance, 1.0));
  EXPECT_TRUE(sweep(kFloor, ball, Motion(at(Vec3(0, -10, 0.2)), at(Vec3(0, 0, 0.2))), 0.0, kTolerance, 1.0));
}

}  // namespace
}  // namespace octoblisk::detail
