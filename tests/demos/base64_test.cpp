#include "io/base64.h"

#include <gtest/gtest.h>

#include <string>

#include "demos/packed_numbers.h"

namespace octoblisk::demos {
namespace {

TEST(Base64, isRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(decoded(base64(std::string("\xff\x00\x7f", 3))), std::string("\xff\x00\x7f", 3));
}

}  // namespace
}  // namespace octoblisk::demos
