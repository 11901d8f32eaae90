// The expected result of bad input to the octoblisk command.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "demos/command.h"

namespace octoblisk::demos {

/// Exit code 2, and a one-line message of the command that names the fault.
inline void expectRefusal(const Outcome& outcome, const std::string& named) {
  EXPECT_EQ(outcome.exit_code, 2) << named;
  EXPECT_THAT(outcome.error, ::testing::StartsWith("octoblisk: "));
  EXPECT_THAT(outcome.error, ::testing::HasSubstr(named));
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
}

}  // namespace octoblisk::demos
