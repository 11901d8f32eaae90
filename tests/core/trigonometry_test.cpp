// Compares sine, cosine and angle with the C library in extended precision.
#include "base/trigonometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shared/meshes.h"

namespace octoblisk {

using namespace detail;

namespace {

/// The error of the C library's sine, relative to the angle.
#ifdef _WIN32
constexpr double kOracleError = 0x1p-66;  // the x87 instruction's π has 66 bits
#else
constexpr double kOracleError = 0.0;
#endif

TEST(Trigonometry, sineAndCosineAreThoseOfTheCLibrary) {
  std::mt19937_64 random(3);
  for (const double size : {1e-9, 1.0, 10.0, 1e6}) {
    for (int i = 0; i < 20000; ++i) {
      const double angle = testing::uniform(random, -size, size);
      const auto [sine, cosine] = sineCosine(angle);
      EXPECT_NEAR(sine, static_cast<double>(sinl(angle)), 4e-16 + kOracleError * size) << angle;
      EXPECT_NEAR(cosine, static_cast<double>(cosl(angle)), 4e-16 + kOracleError * size) << angle;
      if (size < 1.0) {
        EXPECT_NEAR(sine, angle, 1e-16 * size);
      }
    }
  }
  // For a large angle, within the resolution of a double.
  EXPECT_NEAR(sineCosine(1e9).sine, static_cast<double>(sinl(1e9L)), 1e-7);
}

TEST(Trigonometry, isExactOnTheAxes) {
  EXPECT_EQ(sineCosine(0.0).sine, 0.0);
  EXPECT_EQ(sineCosine(0.0).cosine, 1.0);
  EXPECT_EQ(angleOf(0.0, 2.0), 0.0);
  EXPECT_EQ(angleOf(2.0, 0.0), std::numbers::pi / 2.0);
}

TEST(Trigonometry, angleIsThatOfTheCLibrary) {
  std::mt19937_64 random(4);
  for (const double size : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
    for (int i = 0; i < 20000; ++i) {
      const double y = testing::uniform(random, 0.0, size), x = testing::uniform(random, 0.01, 1.0);
      EXPECT_NEAR(angleOf(y, x), static_cast<double>(atan2l(y, x)), 6e-16) << y << ' ' << x;
    }
  }
}

}  // namespace
}  // namespace octoblisk
