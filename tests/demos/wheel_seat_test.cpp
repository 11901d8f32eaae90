// Contact wheels seated on a surface: their positions, compared with closed forms.
#include "toolpath/wheel_seat.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace octoblisk::demos {
namespace {

constexpr double kWheelRadius = 9.5, kBeltWidth = 20.0, kDepth = 0.02;

/// A surface y = bulge · (z² − x²·0) over x and z within ± 30: a trough along x if the bulge is positive.
TriangleMesh trough(double bulge) {
  constexpr int kSteps = 120;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double x = 60.0 * i / kSteps - 30.0, z = 60.0 * k / kSteps - 30.0;
      vertices.emplace_back(x, bulge * z * z, z);
    }
  }
  const auto at = [](int i, int k) { return static_cast<std::uint32_t>(i * (kSteps + 1) + k); };
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return {vertices, triangles};
}

/// The height of the wheel's axis over the trough's bottom when it is seated from the nominal pose, with its
/// axis along z.
double seatedHeight(double bulge) {
  const TriangleMesh surface = trough(bulge);
  const std::vector<int> blades(surface.triangleCount(), 1);
  const WheelSeat seat(surface, blades, 1, kWheelRadius, kBeltWidth);
  Pose nominal;
  nominal.translation = Vec3(0.3, kWheelRadius - kDepth, 0.0);
  const Pose seated = seat.seated(nominal, Vec3::UnitY(), kDepth);
  EXPECT_EQ(seated.rotation, nominal.rotation);
  EXPECT_EQ(seated.translation.x(), nominal.translation.x());
  return seated.translation.y();
}

TEST(WheelSeat, onAFlatOrBulgingSurfaceIsWhereItTouchesThePoint) {
  EXPECT_NEAR(seatedHeight(0.0), kWheelRadius - kDepth, 3e-3);
  EXPECT_NEAR(seatedHeight(-0.01), kWheelRadius - kDepth, 3e-3);
}

TEST(WheelSeat, inATroughLiesOnItsEdges) {
  // At the wheel's edges, 10 mm from the middle, the trough has this height.
  for (const double bulge : {0.002, 0.006, 0.02}) {
    const double edge = bulge * 0.25 * kBeltWidth * kBeltWidth;
    EXPECT_NEAR(seatedHeight(bulge), edge + kWheelRadius - kDepth, 3e-3 + 0.001 * edge) << bulge;
  }
}

TEST(WheelSeat, refusesWhatIsNoWheelOrNoBlade) {
  const TriangleMesh surface = trough(0.0);
  const std::vector<int> blades(surface.triangleCount(), 1);
  EXPECT_THROW(WheelSeat(surface, blades, 2, kWheelRadius, kBeltWidth), std::invalid_argument);
  EXPECT_THROW(WheelSeat(surface, blades, 1, 0.0, kBeltWidth), std::invalid_argument);
  EXPECT_THROW(WheelSeat(surface, blades, 1, kWheelRadius, -1.0), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::demos
