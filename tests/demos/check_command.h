// A fixture that runs octoblisk check as users do: the real executable, in its own folder.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "demos/command.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"

namespace octoblisk::demos {

inline const std::string kPoseHeader = "x,y,z,qw,qx,qy,qz\n";
/// With few stations the belt follows the wheels less closely, so it needs a wider gap, mm.
inline const std::string kCoarseBelt = " --stations 96 --points-per-station 16 --wheel-gap 0.2";

class CheckCommand : public ::testing::Test {
 protected:
  /// Runs `octoblisk` in the scratch folder.
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }

  void make(const std::string& arguments) {
    const Outcome made = run("make " + arguments);
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  void makeMeshes(const std::string& extension) {
    make("blisk --triangles 10000 --out blisk" + extension);
    make("belt" + kCoarseBelt + " --out belt" + extension);
  }

  Outcome check(const std::string& extension, const std::string& poses, const std::string& out) {
    return run("check --fixed blisk" + extension + " --moving belt" + extension + " --poses " + poses +
               " --out " + out);
  }

  TriangleMesh mesh(const std::string& name) { return readMesh(folder_.path() / name); }

  /// Exit code 2, and one line that begins with the place.
  void expectRefused(const std::string& arguments, const std::string& place) {
    const Outcome outcome = run("check " + arguments);
    EXPECT_EQ(outcome.out, "") << arguments;
    expectRefusal(outcome, "octoblisk: " + place);
  }

  ScratchFolder folder_;
};

}  // namespace octoblisk::demos
