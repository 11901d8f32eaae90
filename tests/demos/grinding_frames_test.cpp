// Frames of a film and their contact sheet.
#include <gtest/gtest.h>

#include "report/grinding_pictures.h"

namespace octoblisk::demos {
namespace {

TEST(GrindingFrames, posesAreEvenlySpreadFromFirstToLast) {
  EXPECT_EQ(posesOfFrames(101, 5), (std::vector<std::size_t>{0, 25, 50, 75, 100}));
  EXPECT_EQ(posesOfFrames(3, 9), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(posesOfFrames(7, 1), (std::vector<std::size_t>{0}));
  EXPECT_TRUE(posesOfFrames(7, 0).empty());
  for (std::size_t poses = 2; poses < 40; ++poses) {
    for (std::size_t count = 2; count <= poses; ++count) {
      const std::vector<std::size_t> chosen = posesOfFrames(poses, count);
      ASSERT_EQ(chosen.size(), count);
      EXPECT_EQ(chosen.front(), 0u);
      EXPECT_EQ(chosen.back(), poses - 1);
      for (std::size_t i = 1; i < count; ++i) EXPECT_LT(chosen[i - 1], chosen[i]);
    }
  }
}

}  // namespace
}  // namespace octoblisk::demos
