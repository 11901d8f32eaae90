// --units: meshes in metres and inches beside a tool in mm.
#include <filesystem>
#include <string>

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

  ScratchFolder folder_;
  static constexpr const char* kGrind = " --poses-only --no-pictures --no-report --out run";
};

TEST_F(Units, sizesThatDoNotFitAreRefusedBeforeAnythingIsComputed) {
  for (const auto& [unit, factor, size] :
       {std::tuple("m", "1000", "0.7077"), std::tuple("in", "25.4", "27.86")}) {
    const std::string file = std::string(unit) + ".ply";
    const std::string expected = file + ": the blisk is " + size +
                                 " mm across, the belt 347.3 mm: one of the two " + "is not in mm. --units " +
                                 unit + " (a factor of " + factor +
                                 ") would make the blisk 707.7 mm; --units mm takes the sizes as they are";
    expectRefusal(run("grind --blisk " + file + kGrind), expected);
    expectRefusal(run("access --blisk " + file + " --out run"), expected);
    expectRefusal(run("repair --blisk " + file + " --path poses.csv --out run"), expected);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "run"));
  }
  expectRefusal(run("path --blisk m.ply --out path.csv"),
                "m.ply: the blisk is 0.7077 mm across, the contact wheel 19 mm: one of the two is not in mm. "
                "--units m (a "
                "factor of 1000)");
}

TEST_F(Units, givenOrFoundTheyGiveTheVerdictsOfMillimetres) {
  const Outcome expected = run("grind --blisk mm.ply" + std::string(kGrind));
  EXPECT_EQ(expected.exit_code, 1) << expected.error;
  const auto firstLine = [](const Outcome& outcome) { return outcome.out.substr(0, outcome.out.find('\n')); };
  for (const std::string unit : {"m", "in"}) {
    const Outcome given = run("grind --units " + unit + " --blisk " + unit + ".ply" + kGrind);
    EXPECT_EQ(firstLine(given), firstLine(expected)) << given.error;
    EXPECT_EQ(given.error, "");
    const Outcome found = run("grind --units auto --blisk " + unit + ".ply" + kGrind);
    EXPECT_EQ(firstLine(found), firstLine(expected));
    EXPECT_THAT(found.error, HasSubstr("note: " + unit + ".ply: read in " + unit + ": "));
    EXPECT_THAT(run("blades --units auto --blisk " + unit + ".ply --no-picture --out blades").out,
                HasSubstr("24 blades "));
    EXPECT_EQ(run("path --units " + unit + " --blisk " + unit + ".ply --out " + unit + ".csv").exit_code, 0);
  }
  EXPECT_THAT(run("grind --units auto --blisk mm.ply" + std::string(kGrind)).error,
              HasSubstr("note: mm.ply: read in mm: "));
}

TEST_F(Units, aMarginThatMakesAllTrianglesNearIsRefused) {
  expectRefusal(run("grind --units mm --blisk m.ply" + std::string(kGrind)),
                "--near-miss 0.5: for a blisk of 0.7077 mm it may be at most 0.01415");
  expectRefusal(run("access --units mm --blisk m.ply --margin 0.5 --out run"),
                "--margin 0.5: for a blisk of 0.7077 mm it may be at most 0.01415");
}

}  // namespace
}  // namespace octoblisk::demos
