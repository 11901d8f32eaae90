// octoblisk grind: a user's meshes and tools.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "demos/grind_command.h"
#include "demos/read_table.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

TEST_F(GrindCommand, ownFilesAreUsedAndTheBladeIsFoundByTouch) {
  ASSERT_EQ(
      runOctoblisk(folder_.path(), "make blisk --triangles 10000 --blades 20 --out blisk.stl").exit_code, 0);
  ASSERT_EQ(runOctoblisk(folder_.path(), "make belt --out belt.obj").exit_code, 0);
  ASSERT_LE(run("--blisk blisk.stl --ground-blade 5 --no-pictures --out first").exit_code, 1);
  ASSERT_LE(
      run("--blisk blisk.stl --belt belt.obj --path first/path.csv --no-pictures --out second").exit_code, 1);
  const auto summary = nlohmann::json::parse(contentOf(file("second/summary.json")));
  EXPECT_EQ(summary["limits"]["ground_blade"], 5);
  EXPECT_EQ(summary["blisk"]["blades"], 20);
  EXPECT_EQ(summary["parts"].size(), 1u);
}

TEST_F(GrindCommand, theToolThatMakeWritesGrindsAsTheBuiltInOne) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make grinder --out tool").exit_code, 0);
  ASSERT_LE(run("--poses-only --no-pictures --out built_in").exit_code, 1);
  const Outcome outcome = run("--tool tool/tool.json --poses-only --no-pictures --out own");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.error, "");
  const auto summary = nlohmann::json::parse(contentOf(file("own/summary.json")));
  EXPECT_EQ(summary["parts"].size(), 5u);
  const auto own = readTable(file("own/poses.csv")), built_in = readTable(file("built_in/poses.csv"));
  ASSERT_EQ(own.size(), built_in.size());
  // The two parts of the belt behave like the whole belt; the back is half a millimetre from the surface that
  // the contact side touches, and has a smaller margin there. No other part comes as near as its margin.
  std::size_t intended = 0;
  for (std::size_t pose = 0; pose < own.size(); ++pose) {
    EXPECT_EQ(own[pose].at("verdict"), built_in[pose].at("verdict")) << "pose " << pose;
    if (own[pose].at("verdict") != "intended contact") continue;
    ++intended;
    EXPECT_EQ(own[pose].at("part"), "belt contact side");
  }
  EXPECT_GT(intended, own.size() / 4);

  // In an edited table the belt may touch nothing.
  std::string edited = contentOf(file("tool/tool.json"));
  edited.replace(edited.find("\"ground\""), 8, std::string("2"));
  folder_.write("tool/edited.json", edited);
  ASSERT_EQ(run("--tool tool/edited.json --poses-only --no-pictures --out edited").exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(contentOf(file("edited/summary.json")))["poses"]["intended_contact"], 0);
  EXPECT_THAT(run("--tool tool/edited.json --ground-blade 3 --out edited").error,
              HasSubstr("no part may touch that blade"));
  edited.replace(edited.find("\"blade\": 2"), 10, std::string("\"blade\": 99"));
  folder_.write("tool/edited.json", edited);
  EXPECT_THAT(run("--tool tool/edited.json --out edited").error, HasSubstr("blade 99: the blisk has 24"));
}

}  // namespace
}  // namespace octoblisk::demos
