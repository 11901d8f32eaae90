// octoblisk repair, between two runs of octoblisk grind.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "demos/command.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "toolpath/cl_motions.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

class RepairCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }

  /// The poses that grind calls interference.
  std::set<std::size_t> interfering(const std::string& folder) const {
    std::set<std::size_t> poses;
    const auto summary = nlohmann::json::parse(contentOf(file(folder + "/summary.json")));
    for (const auto& range : summary["interfering_poses"]) {
      for (std::size_t pose = range["first"]; pose <= range["last"]; ++pose) poses.insert(pose);
    }
    return poses;
  }

  /// The poses that changes.csv lists as left.
  std::set<std::size_t> left(const std::string& folder) const {
    std::set<std::size_t> poses;
    for (const auto& row : readTable(file(folder + "/changes.csv"))) {
      if (row.at("after") == "interference") poses.insert(std::stoul(row.at("pose")));
    }
    return poses;
  }

  /// The section [from, to) of a path.
  void cut(const std::string& from_file, std::size_t from, std::size_t to, const std::string& to_file) const {
    const std::vector<Pose> path = readPoses(file(from_file));
    ASSERT_LE(to, path.size());
    writePoses(file(to_file), std::span(path).subspan(from, to - from));
  }

  ScratchFolder folder_;
};

TEST_F(RepairCommand, grindRepairGrindOfTheDefaultBliskEndsClean) {
  ASSERT_EQ(run("grind --no-pictures --out first").exit_code, 1);
  cut("first/path.csv", 222, 242, "part.csv");
  ASSERT_EQ(run("grind --path part.csv --no-pictures --out before").exit_code, 1);
  EXPECT_GE(interfering("before").size(), 4u);
  const Outcome repaired = run("repair --path part.csv --out repaired");
  EXPECT_EQ(repaired.exit_code, 0) << repaired.out << repaired.error;
  EXPECT_EQ(repaired.error, "");
  EXPECT_THAT(repaired.out, HasSubstr("20 poses, ground blade 1 of 24"));
  EXPECT_TRUE(left("repaired").empty());
  const Outcome after = run("grind --path repaired/path.csv --ground-blade 1 --no-pictures --out after");
  EXPECT_EQ(after.exit_code, 0) << after.out;
  EXPECT_EQ(readPoses(file("repaired/path.csv")).size(), 20u);
  EXPECT_THAT(contentOf(file("repaired/changes.csv")), HasSubstr("belt too deep in blade 1"));

  // Free poses stay as they are.
  const Outcome again = run("repair --path repaired/path.csv --ground-blade 1 --out again");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.out, HasSubstr(": 0 interfered; left: 0 poses, 0 motions between free poses"));
  EXPECT_THAT(again.out, ::testing::Not(HasSubstr("Changed:")));
}

TEST_F(RepairCommand, aClFileComesBackAsAClFileWithItsFeeds) {
  ASSERT_EQ(run("grind --no-pictures --poses-only --out first").exit_code, 1);
  const std::vector<Pose> path = readPoses(file("first/path.csv"));
  std::vector<ToolMotion> motions;
  for (std::size_t i = 222; i < 242; ++i) motions.push_back({path[i], i < 225 ? 0.0 : 1000.0});
  writeClFile(file("op20.cls"), motions);
  const Outcome repaired = run("repair --path op20.cls --no-report --out repaired");
  EXPECT_EQ(repaired.exit_code, 0) << repaired.out << repaired.error;
  EXPECT_THAT(repaired.out, HasSubstr("Path: repaired/path.cls, "));
  EXPECT_FALSE(std::filesystem::exists(file("repaired/path.csv")));
  const std::vector<ToolMotion> back = toolMotionsOf(readClFile(file("repaired/path.cls")));
  ASSERT_EQ(back.size(), motions.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_EQ(back[i].feed, motions[i].feed);
    changed += (back[i].tool_in_blisk.translation - motions[i].tool_in_blisk.translation).norm() > 1e-6 ||
               (back[i].tool_in_blisk.rotation - motions[i].tool_in_blisk.rotation).norm() > 1e-6;
  }
  EXPECT_GE(changed, 4u);
  EXPECT_EQ(run("grind --path repaired/path.cls --ground-blade 1 --no-pictures --out after").exit_code, 0);
  // The path that grind writes also has the feeds.
  EXPECT_THAT(contentOf(file("after/path.csv")), HasSubstr("x,y,z,qw,qx,qy,qz,feed\n"));
  const Outcome of_table = run("repair --path after/path.csv --ground-blade 1 --no-report --out again");
  EXPECT_EQ(of_table.exit_code, 0) << of_table.error;
  EXPECT_EQ(contentOf(file("again/path.csv")), contentOf(file("after/path.csv")));
}

TEST_F(RepairCommand, grindRepairGrindOfAShroudedBliskEndsClean) {
  ASSERT_EQ(run("make blisk --triangles 10000 --shroud --out s.ply").exit_code, 0);
  ASSERT_EQ(run("grind --blisk s.ply --poses-only --no-pictures --out first").exit_code, 1);
  cut("first/path.csv", 60, 90, "part.csv");
  ASSERT_EQ(run("grind --blisk s.ply --ground-blade 1 --path part.csv --no-pictures --out before").exit_code,
            1);
  EXPECT_GE(interfering("before").size(), 10u);
  const Outcome repaired = run("repair --blisk s.ply --ground-blade 1 --path part.csv --out repaired");
  EXPECT_EQ(repaired.exit_code, 0) << repaired.out << repaired.error;
  const Outcome after =
      run("grind --blisk s.ply --ground-blade 1 --path repaired/path.csv --no-pictures --out after");
  EXPECT_EQ(after.exit_code, 0) << after.out;
  EXPECT_THAT(after.out, HasSubstr("30 intended contact")) << "it still grinds";
}

TEST_F(RepairCommand, ofAShroudedBliskNamesWhatIsLeftAsGrindDoes) {
  ASSERT_EQ(run("make blisk --triangles 10000 --shroud --out s.ply").exit_code, 0);
  ASSERT_EQ(
      run("path --blisk s.ply --arm outward --step-over 40 --pose-step 12 --retract 0 --out through.csv")
          .exit_code,
      0);
  cut("through.csv", 0, 6, "part.csv");
  const Outcome repaired =
      run("repair --blisk s.ply --ground-blade 1 --path part.csv --tilt 8 --slide 4 "
          "--retract 4 --out repaired");
  ASSERT_LE(repaired.exit_code, 1) << repaired.error;
  ASSERT_LE(run("grind --blisk s.ply --ground-blade 1 --path repaired/path.csv --no-pictures --out after")
                .exit_code,
            1);
  EXPECT_EQ(left("repaired"), interfering("after"));
  EXPECT_FALSE(left("repaired").empty()) << "the arm cannot go through a shroud";
  EXPECT_EQ(repaired.exit_code, 1);
  EXPECT_THAT(repaired.out, HasSubstr("\nLeft: pose"));
}

TEST_F(RepairCommand, badInputIsOneLineThatNamesItAndWritesNothing) {
  folder_.write("short.csv", "x,y,z,qw,qx,qy,qz\n1,2,3\n");
  folder_.write("path.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n");
  const std::pair<const char*, const char*> cases[] = {
      {"--path missing.csv --out run", "missing.csv"},
      {"--path short.csv --out run", "short.csv:2"},
      {"--path path.csv --out .", "path.csv: is also an input file"},
      {"--tilt-grid 5 --out run", "--tilt-grid: must not be above --tilt-per-pose"},
      {"--ground-blade 99 --out run", "--ground-blade 99"},
      {"--tilt 1000 --tilt-grid 0.01 --out run", "too many combinations"}};
  for (const auto& [arguments, named] : cases) {
    expectRefusal(run("repair " + std::string(arguments)), named);
    EXPECT_FALSE(std::filesystem::exists(file("run")));
  }
  for (const char* arguments :
       {"--tilt -1 --out run", "--retract-grid 0 --out run", "--slide nan --out run"}) {
    expectRefusal(run("repair " + std::string(arguments)), "octoblisk: --");
  }
  EXPECT_THAT(run("repair --help").out, HasSubstr("changes.csv"));
}

}  // namespace
}  // namespace octoblisk::demos
