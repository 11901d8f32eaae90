#include "report/power_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace octoblisk::bench {
namespace {

TEST(PowerLaw, isFoundWherePointsLieOnIt) {
  for (const double exponent : {-1.0, 0.0, 0.3, 1.0, 2.5}) {
    std::vector<double> x, y;
    for (const double size : {10.0, 30.0, 1000.0, 5e6}) {
      x.push_back(size);
      y.push_back(7.0 * std::pow(size, exponent));
    }
    const PowerLaw law = fitPowerLaw(x, y);
    EXPECT_NEAR(law.exponent, exponent, 1e-12);
    EXPECT_NEAR(law.factor, 7.0, 1e-9);
  }
}

// For three points with logarithms 0, 1, 2 and 0, 3, 3 the closed form gives a slope of 3/2.
TEST(PowerLaw, isOfLeastSquaresBetweenLogarithms) {
  const std::vector<double> x = {1.0, std::exp(1.0), std::exp(2.0)}, y = {1.0, std::exp(3.0), std::exp(3.0)};
  const PowerLaw law = fitPowerLaw(x, y);
  EXPECT_NEAR(law.exponent, 1.5, 1e-12);
  EXPECT_NEAR(law.factor, std::exp(0.5), 1e-12);
}

TEST(PowerLaw, refusesWhatHasNone) {
  const std::vector<double> one = {1.0}, two = {1.0, 2.0}, same = {3.0, 3.0}, zero = {0.0, 1.0};
  EXPECT_THROW(fitPowerLaw(one, one), std::invalid_argument);
  EXPECT_THROW(fitPowerLaw(two, one), std::invalid_argument);
  EXPECT_THROW(fitPowerLaw(same, two), std::invalid_argument);
  EXPECT_THROW(fitPowerLaw(zero, two), std::invalid_argument);
  EXPECT_THROW(fitPowerLaw(two, zero), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::bench
