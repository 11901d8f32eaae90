// Frames of a film and their contact sheet.
#include "report/grinding_frames.h"

#include <gtest/gtest.h>

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

TEST(GrindingFrames, sheetHasEachPictureWholeInItsPlace) {
  std::vector<Image> pictures;
  for (std::uint8_t i = 0; i < 5; ++i) {
    pictures.emplace_back(4, 3, Image::Pixel{i, 0, 0, 255});
    pictures.back().at(1, 2) = {i, 9, 9, 255};
  }
  Image sheet = contactSheetOf(pictures);
  ASSERT_EQ(sheet.width, 2 * 4);
  ASSERT_EQ(sheet.height, 3 * 3);
  for (int i = 0; i < 5; ++i) {
    const int left = i % 2 * 4, top = i / 2 * 3;
    EXPECT_EQ(sheet.at(left, top), (Image::Pixel{static_cast<std::uint8_t>(i), 0, 0, 255}));
    EXPECT_EQ(sheet.at(left + 1, top + 2), (Image::Pixel{static_cast<std::uint8_t>(i), 9, 9, 255}));
  }
  EXPECT_EQ(sheet.at(4, 6), (Image::Pixel{255, 255, 255, 255}));
  EXPECT_THROW(contactSheetOf({}), std::invalid_argument);
  pictures.emplace_back(3, 3, Image::Pixel{});
  EXPECT_THROW(contactSheetOf(pictures), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::demos
