// octoblisk grind: bad input gives a one-line message that names it, and existing files stay as they are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "demos/grind_command.h"
#include "demos/refusal.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(GrindCommand, badInputIsOneLineThatNamesIt) {
  folder_.write("empty.stl", "");
  folder_.write("short.csv", "x,y,z,qw,qx,qy,qz\n1,2,3\n");
  folder_.write("far.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n300,0,2e6,1,0,0,0\n");
  folder_.write("a_file", "");
  ASSERT_EQ(runOctoblisk(folder_.path(), "make belt --out round.ply").exit_code, 0);
  const std::pair<const char*, const char*> cases[] = {
      {"--blisk missing.stl --out run", "missing.stl"},
      {"--blisk empty.stl --out run", "empty.stl"},
      {"--path short.csv --out run", "short.csv:2"},
      {"--path far.csv --out run", "far.csv:3: the tool is more than 1e6 mm from the origin"},
      {"--out a_file/run", "a_file/run"},
      {"--blisk round.ply --out run", "round.ply: no blades were found"},
      {"--ground-blade 99 --out run", "99"}};
  for (const auto& [arguments, named] : cases) {
    expectRefusal(run(arguments), named);
  }
  EXPECT_EQ(run("").exit_code, 2);
  for (const char* arguments :
       {"--max-depth -1 --out run", "--max-depth nan --out run", "--max-depth 1e999 --out run",
        "--near-miss 0 --out run", "--near-miss nan --out run", "--near-miss 1e9 --out run", "--out ''",
        "--blisk '' --out run", "--path '' --out run", "--ground-blade 0 --out run",
        "--partition paper:9 --out run", "--partition paper:2:0 --out run", "--partition octree --out run"}) {
    const Outcome outcome = run(arguments);
    expectRefusal(outcome, "octoblisk: --");
    EXPECT_LT(outcome.error.size(), 120u) << outcome.error;
  }
  EXPECT_EQ(run("--help").exit_code, 0);
}

TEST_F(GrindCommand, badInputLeavesTheTablesOfAnEarlierRun) {
  folder_.write("away.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n");
  ASSERT_EQ(run("--path away.csv --no-pictures --out run").exit_code, 0);
  const std::string before = contentOf(file("run/poses.csv"));
  folder_.write("bad.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n300,0\n");
  EXPECT_EQ(run("--path bad.csv --no-pictures --out run").exit_code, 2);
  EXPECT_EQ(contentOf(file("run/poses.csv")), before);
  for (const auto& entry : std::filesystem::directory_iterator(file("run"))) {
    EXPECT_THAT(entry.path().filename().string(), ::testing::Not(StartsWith("unfinished")));
  }
}

TEST_F(GrindCommand, neverWritesATableOverThePathItReads) {
  const std::string path = "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n";
  folder_.write("poses.csv", path);
  const Outcome refused = run("--path poses.csv --no-pictures --out .");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("poses.csv: is also an input file"));
  EXPECT_EQ(contentOf(file("poses.csv")), path);
}

}  // namespace
}  // namespace octoblisk::demos
