// octoblisk check: bad input gives a one-line message that names it.
#include <algorithm>
#include <filesystem>
#include <string>

#include "demos/check_command.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

class CheckRefusal : public CheckCommand {
 protected:
  void SetUp() override {
    makeMeshes(".stl");
    folder_.write("poses.csv", kPoseHeader + "0,0,0,1,0,0,0\n");
  }

  void expectMeshRefused(const std::string& name) {
    expectRefused("--fixed " + name + " --moving belt.stl --poses poses.csv --out result.csv", name);
    expectRefused("--fixed blisk.stl --moving " + name + " --poses poses.csv --out result.csv", name);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "result.csv"));
  }

  void expectPosesRefused(const std::string& content, const std::string& line) {
    folder_.write("bad.csv", content);
    expectRefused("--fixed blisk.stl --moving belt.stl --poses bad.csv --out result.csv",
                  "bad.csv:" + line + ": ");
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "result.csv"));
  }

  void expectOutRefused(const std::string& name) {
    expectRefused("--fixed blisk.stl --moving belt.stl --poses poses.csv --out " + name, name + ": ");
  }
};

TEST_F(CheckRefusal, ofBadMeshesNamesThem) {
  expectMeshRefused("missing.stl");
  folder_.write("mesh.step", "no mesh");
  expectMeshRefused("mesh.step");
  expectMeshRefused("/dev/null");
  for (const std::string extension : {".stl", ".ply", ".obj"}) {
    folder_.write("empty" + extension, "");
    expectMeshRefused("empty" + extension);
    make("belt" + kCoarseBelt + " --out whole" + extension);
    const std::string whole = contentOf(folder_.path() / ("whole" + extension));
    folder_.write("truncated" + extension, whole.substr(0, whole.size() - 7));
    expectMeshRefused("truncated" + extension);
  }
}

TEST_F(CheckRefusal, ofBadPosesNamesFileAndLine) {
  const std::string good = "0,0,0,1,0,0,0\n";
  expectPosesRefused("", "1");
  expectPosesRefused("x,y,z,qx,qy,qz,qw\n" + good, "1");
  expectPosesRefused(kPoseHeader + good + "nan,0,0,1,0,0,0\n", "3");
  expectPosesRefused(kPoseHeader + good + good + "0,0,0,1,0,0\n", "4");
  expectPosesRefused(kPoseHeader + "0,0,0,0,0,0,0\n" + good, "2");
  expectPosesRefused(kPoseHeader + "0,0,0,one,0,0,0\n", "2");
  expectPosesRefused(kPoseHeader + "+-5,0,0,1,0,0,0\n", "2");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses missing.csv --out result.csv",
                "missing.csv: no such file");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses . --out result.csv", ".: is a folder");
  expectRefused("--fixed . --moving belt.stl --poses poses.csv --out result.csv", ".: is a folder");
  expectRefused("--fixed blisk.stl --moving belt.stl --poses belt.stl --out result.csv",
                "belt.stl:1: the file is binary");
  folder_.write("none.csv", kPoseHeader);
  expectRefused("--fixed blisk.stl --moving belt.stl --poses none.csv --out result.csv", "none.csv: ");
}

TEST_F(CheckRefusal, ofAResultThatCannotBeWrittenNamesIt) {
  expectOutRefused("missing/result.csv");
  expectOutRefused(".");
  if (std::filesystem::exists("/dev/full")) expectOutRefused("/dev/full");
  const std::string poses = contentOf(folder_.path() / "poses.csv");
  expectOutRefused("./poses.csv");
  EXPECT_EQ(contentOf(folder_.path() / "poses.csv"), poses) << "input must not be overwritten";
}

TEST_F(CheckRefusal, leavesTheResultOfAnEarlierRunAsItWas) {
  folder_.write("result.csv", "earlier");
  expectRefused("--fixed missing.stl --moving belt.stl --poses poses.csv --out result.csv", "missing.stl");
  EXPECT_EQ(contentOf(folder_.path() / "result.csv"), "earlier");
}

TEST_F(CheckRefusal, ofOptionsItDoesNotKnow) {
  const std::string good = "check --fixed blisk.stl --moving belt.stl --poses poses.csv ";
  for (const std::string& arguments :
       {good + "--out result.csv --blades 3", good, std::string("check"), std::string("")}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_THAT(std::ranges::count(outcome.error, '\n'), ::testing::AllOf(::testing::Ge(1), ::testing::Le(2)))
        << outcome.error;
  }
  EXPECT_THAT(run(good + "--out result.csv --blades 3").error, HasSubstr("--blades"));
}

}  // namespace
}  // namespace octoblisk::demos
