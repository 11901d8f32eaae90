// --units: meshes in metres and inches beside a tool in mm.
#include <filesystem>
#include <string>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"
#include "models/embedded_assets.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

class Units : public ::testing::Test {
 protected:
  void SetUp() override {
    const TriangleMesh blisk = embeddedBlisk();
    for (const auto& [name, millimetres] :
         {std::pair("mm", 1.0), std::pair("m", 1000.0), std::pair("in", 25.4)}) {
      std::vector<Vec3> vertices = blisk.vertices();
      for (Vec3& vertex : vertices) vertex /= millimetres;
      writeMesh(folder_.path() / (std::string(name) + ".ply"), {std::move(vertices), blisk.triangles()});
    }
  }

  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }

  static std::string firstLine(const Outcome& outcome) {
    return outcome.out.substr(0, outcome.out.find('\n'));
  }

  static void toInches(const std::filesystem::path& from, const std::filesystem::path& to) {
    const TriangleMesh mesh = readMesh(from);
    std::vector<Vec3> vertices = mesh.vertices();
    for (Vec3& vertex : vertices) vertex /= 25.4;
    writeMesh(to, {std::move(vertices), mesh.triangles()});
  }

  ScratchFolder folder_;
  static constexpr const char* kGrind = " --poses-only --no-pictures --no-report --out run";
};

TEST_F(Units, sizesThatDoNotFitAreRefusedBeforeAnythingIsComputed) {
  for (const auto& [unit, factor, size] :
       {std::tuple("m", "1000", "0.7077"), std::tuple("in", "25.4", "27.86")}) {
    const std::string file = std::string(unit) + ".ply";
    const std::string expected = file + ": the blisk is " + size +
                                 " mm across, the belt is 347.3 mm: one of them " +
                                 "probably has another unit. --units " + unit + " (a factor of " + factor +
                                 ") would make the blisk 707.7 mm; --units mm accepts the sizes as they are";
    expectRefusal(run("grind --blisk " + file + kGrind), expected);
    expectRefusal(run("access --blisk " + file + " --out run"), expected);
    expectRefusal(run("repair --blisk " + file + " --path poses.csv --out run"), expected);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "run"));
  }
  expectRefusal(
      run("path --blisk m.ply --out path.csv"),
      "m.ply: the blisk is 0.7077 mm across, the contact wheel is 19 mm: one of them probably has another unit. "
      "--units m (a "
      "factor of 1000)");
  // A mesh in mm that is read as if it were in m.
  for (const char* command : {"grind --units m --blisk mm.ply --poses-only --no-pictures --no-report --out run",
                              "path --units m --blisk mm.ply --out path.csv"}) {
    expectRefusal(run(command), "mm.ply: the blisk is 7.077e+05 mm across, ");
    EXPECT_THAT(run(command).error, HasSubstr("--units mm accepts the sizes as they are"));
  }
}

TEST_F(Units, givenOrFoundTheyGiveTheVerdictsOfMillimetres) {
  const Outcome expected = run("grind --blisk mm.ply" + std::string(kGrind));
  EXPECT_EQ(expected.exit_code, 1) << expected.error;
  for (const std::string unit : {"m", "in"}) {
    const Outcome given = run("grind --units " + unit + " --blisk " + unit + ".ply" + kGrind);
    EXPECT_EQ(firstLine(given), firstLine(expected)) << given.error;
    EXPECT_EQ(given.error, "");
    const Outcome found = run("grind --units auto --blisk " + unit + ".ply" + kGrind);
    EXPECT_EQ(firstLine(found), firstLine(expected));
    EXPECT_THAT(found.error, HasSubstr("note: " + unit + ".ply: read in " + unit + ", because "));
    EXPECT_THAT(run("blades --units auto --blisk " + unit + ".ply --no-picture --out blades").out,
                HasSubstr("24 blades "));
    EXPECT_EQ(run("path --units " + unit + " --blisk " + unit + ".ply --out " + unit + ".csv").exit_code, 0);
  }
  EXPECT_THAT(run("grind --units auto --blisk mm.ply" + std::string(kGrind)).error,
              HasSubstr("note: mm.ply: read in mm, because "));
}

TEST_F(Units, ofTheToolAreGivenOrFound) {
  const std::string tables = " --poses-only --no-pictures --no-report --out ";
  ASSERT_EQ(runOctoblisk(folder_.path(), "make grinder --out tool").exit_code, 0);
  ASSERT_EQ(runOctoblisk(folder_.path(), "make belt --out belt.ply").exit_code, 0);
  std::filesystem::create_directories(folder_.path() / "inches");
  std::filesystem::copy(folder_.path() / "tool/tool.json", folder_.path() / "inches/tool.json");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "tool")) {
    if (entry.path().extension() == ".ply")
      toInches(entry.path(), folder_.path() / "inches" / entry.path().filename());
  }
  toInches(folder_.path() / "belt.ply", folder_.path() / "belt_in.ply");
  expectRefusal(
      run("grind --belt belt_in.ply" + tables + "run"),
      "the blisk: the blisk is 707.7 mm across, the belt is 13.68 mm: one of them probably has another unit. "
      "--tool-units in (a factor of 25.4) would make the belt 347.3 mm");
  for (const auto& [mm, in] : {std::pair("--belt belt.ply", "--belt belt_in.ply"),
                               std::pair("--tool tool/tool.json", "--tool inches/tool.json")}) {
    const Outcome expected = run(std::string("grind ") + mm + tables + "mm");
    ASSERT_EQ(expected.exit_code, 1) << expected.error;
    const Outcome given = run(std::string("grind --tool-units in ") + in + tables + "in");
    EXPECT_EQ(firstLine(given), firstLine(expected)) << given.error;
    EXPECT_EQ(given.error, "");
    const Outcome found = run(std::string("grind --tool-units auto ") + in + tables + "auto");
    EXPECT_EQ(firstLine(found), firstLine(expected));
    EXPECT_THAT(found.error, HasSubstr(": read in in, because "));
  }
  expectRefusal(run("grind --tool-units in" + tables + "run"), "--tool-units: the built-in tool is in mm");
}

TEST_F(Units, ofObstaclesAreTheBlisks) {
  // A bar of 51 mm, which by its own size could be in inches, far from the tool.
  ASSERT_EQ(
      runOctoblisk(folder_.path(), "make arm --arm-start 300 --wheel-distance 340 --out clamp.ply").exit_code,
      0);
  const std::string arguments = " --obstacle clamp.ply" + std::string(kGrind);
  const Outcome expected = run("grind --blisk mm.ply" + arguments);
  const Outcome found = run("grind --units auto --blisk mm.ply" + arguments);
  EXPECT_EQ(found.out, expected.out);
  EXPECT_THAT(found.error, ::testing::Not(HasSubstr("clamp")));
}

TEST_F(Units, ofAccessRepairAndCheck) {
  const std::string few = " --rows 2 --columns 3 --tilt-step 60 --no-picture --no-report --out ";
  const Outcome access = run("access --blisk mm.ply" + few + "mm");
  EXPECT_EQ(firstLine(run("access --units m --blisk m.ply" + few + "m")), firstLine(access)) << access.error;
  ASSERT_EQ(run("path --blisk mm.ply --height-from 0.45 --height-to 0.5 --out path.csv").exit_code, 0);
  const std::string path = " --path path.csv --no-report --out ";
  const Outcome repair = run("repair --blisk mm.ply" + path + "mm");
  EXPECT_LE(repair.exit_code, 1) << repair.error;
  EXPECT_EQ(firstLine(run("repair --units in --blisk in.ply" + path + "in")), firstLine(repair));
  // Boxes of 4 and 2 mm, in mm and in metres, 1 mm deep in each other.
  folder_.write("poses.csv", "x,y,z,qw,qx,qy,qz\n2,0,0,1,0,0,0\n5,0,0,1,0,0,0\n");
  for (const auto& [name, size] : {std::pair("large", 2.0), std::pair("small", 1.0)}) {
    writeMesh(folder_.path() / (std::string(name) + ".obj"), block(Vec3::Constant(size), 1));
    writeMesh(folder_.path() / (std::string(name) + "_m.obj"), block(Vec3::Constant(size / 1000.0), 1));
  }
  const std::string measures = " --poses poses.csv --clearance --depth --out -";
  const Outcome mm = run("check --fixed large.obj --moving small.obj" + measures);
  EXPECT_EQ(mm.exit_code, 1) << mm.error;
  const Outcome metres = run("check --units m --fixed large_m.obj --moving small_m.obj" + measures);
  EXPECT_EQ(metres.exit_code, 1) << metres.error;
  EXPECT_THAT(mm.out, HasSubstr("\n0,1,"));
  EXPECT_EQ(mm.out.substr(0, 60), metres.out.substr(0, 60));
}

TEST_F(Units, aMarginThatMakesAllTrianglesNearIsRefused) {
  expectRefusal(run("grind --units mm --blisk m.ply" + std::string(kGrind)),
                "--near-miss 0.5: must be at most 0.01415 for a blisk of 0.7077 mm");
  expectRefusal(run("access --units mm --blisk m.ply --margin 0.5 --out run"),
                "--margin 0.5: must be at most 0.01415 for a blisk of 0.7077 mm");
}

}  // namespace
}  // namespace octoblisk::demos
