#include "pages/synopsis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace octoblisk::pages {
namespace {

using ::testing::ElementsAre;

const std::vector<Placeholder> kSamples = {
    {"--in", "FILE", "in.stl"}, {"", "FILE", "any.stl"}, {"", "MM", "3"}, {"", "x,y[,z]", "1,2"}};

TEST(Synopsis, isCalledWithEveryAlternative) {
  EXPECT_THAT(fullCalls("make arm|…|belt --out FILE [--width MM]", kSamples),
              ElementsAre("make arm --out any.stl --width 3", "make belt --out any.stl --width 3"));
  EXPECT_THAT(fullCalls("cut [--in FILE | --all] [--at x,y[,z]] [--by saw|file|laser]", kSamples),
              ElementsAre("cut --in in.stl --at 1,2 --by saw", "cut --all --at 1,2 --by file",
                          "cut --in in.stl --at 1,2 --by laser"));
  EXPECT_EQ(leastCall("cut saw|file --in FILE [--by MM]", kSamples), "cut saw --in in.stl");
}

TEST(Synopsis, isRefusedWhereItIsNotUnderstood) {
  EXPECT_THROW(fullCalls("cut [--by MM", kSamples), std::invalid_argument);
  EXPECT_THROW(fullCalls("cut --by DEG", kSamples), std::invalid_argument);
}

TEST(Synopsis, beginsWithTheCommand) {
  EXPECT_THAT(synopsesOf("do cut --in FILE, do make --out FILE\n   [--width MM]\ndo it\n", "do"),
              ElementsAre("do cut --in FILE", "do make --out FILE    [--width MM]", "do it"));
}

}  // namespace
}  // namespace octoblisk::pages
