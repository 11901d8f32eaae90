// A fixture that runs octoblisk grind as users do, in its own folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "demos/command.h"
#include "demos/scratch_folder.h"

namespace octoblisk::demos {

class GrindCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "grind " + arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  ScratchFolder folder_;
};

}  // namespace octoblisk::demos
