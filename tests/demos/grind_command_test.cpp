// octoblisk grind, run as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "demos/command.h"
#include "demos/scratch_folder.h"
#include "models/embedded_assets.h"
#include "models/mesh_file.h"
#include "models/orientation.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// contacts.csv: its rows by column name.
std::vector<std::map<std::string, std::string>> readContacts(const std::filesystem::path& file) {
  std::istringstream stream(contentOf(file));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> found;
    std::size_t begin = 0;
    for (std::size_t comma; (comma = line.find(',', begin)) != std::string::npos; begin = comma + 1) {
      found.push_back(line.substr(begin, comma - begin));
    }
    found.push_back(line.substr(begin));
    return found;
  };
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = cells(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), header.size());
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i)
      rows.back()[header[i]] = values[i];
  }
  return rows;
}

ClusteredOctree treeOf(TriangleMesh mesh) {
  return ClusteredOctree::build(std::make_shared<const TriangleMesh>(std::move(mesh)));
}

class GrindCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "grind " + arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  ScratchFolder folder_;
};

TEST_F(GrindCommand, defaultPathEqualsCollideOfEveryPart) {
  const Outcome outcome = run("--out run --no-pictures");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;  // the default path has poses that interfere
  EXPECT_EQ(outcome.error, "");                      // no progress bar in a pipe
  EXPECT_FALSE(std::filesystem::exists(file("run/overview.png")));

  const std::vector<Pose> path = readPoses(file("run/path.csv"));
  std::map<std::size_t, std::set<std::string>> touching;  // parts, by pose
  std::set<std::size_t> reported;
  for (auto& row : readContacts(file("run/contacts.csv"))) {
    const std::size_t pose = std::stoul(row["pose"]);
    reported.insert(pose);
    if (!row["depth"].empty() && std::stod(row["depth"]) >= 0.0) touching[pose].insert(row["part"]);
  }
  EXPECT_EQ(reported.size(), path.size());

  const ClusteredOctree blisk = treeOf(embeddedBlisk());
  std::size_t hits = 0, clear = 0;
  for (const EmbeddedPart& part : embeddedBeltGrinder()) {
    const ClusteredOctree tree = treeOf(part.mesh);
    for (std::size_t pose = 0; pose < path.size(); ++pose) {
      const bool touches = collide(blisk, tree, path[pose]).has_value();
      ASSERT_EQ(touching[pose].contains(part.name), touches) << part.name << ", pose " << pose;
      (touches ? hits : clear) += 1;
    }
  }
  EXPECT_GT(hits, path.size() / 4);
  EXPECT_GT(clear, path.size() / 4);

  const auto summary = nlohmann::json::parse(contentOf(file("run/summary.json")));
  const auto& poses = summary["poses"];
  EXPECT_EQ(poses["total"], path.size());
  EXPECT_EQ(poses["clear"].get<std::size_t>() + poses["intended_contact"].get<std::size_t>() +
                poses["near_miss"].get<std::size_t>() + poses["interference"].get<std::size_t>(),
            path.size());
  EXPECT_EQ(summary["blisk"]["blades"], 24);
}

TEST_F(GrindCommand, cleanPathExitsWithZeroAndPicturesShowIt) {
  folder_.write("away.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n310,0,0,1,0,0,0\n");
  const Outcome outcome = run("--path away.csv --out run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("2 clear, 0 intended contact, 0 near miss, 0 interference"));
  EXPECT_GT(std::filesystem::file_size(file("run/overview.png")), 10'000u);
  EXPECT_GT(std::filesystem::file_size(file("run/closeup.png")), 1'000u);
}

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

TEST_F(GrindCommand, aBliskThatFacesInwardGivesTheSameDepths) {
  writeMesh(file("outward.ply"), embeddedBlisk());
  writeMesh(file("inward.ply"), turned(embeddedBlisk()));
  for (const char* way : {"outward", "inward"}) {
    ASSERT_LE(run("--blisk " + std::string(way) + ".ply --no-pictures --out " + way).exit_code, 1);
  }
  const std::string outward = contentOf(file("outward/contacts.csv"));
  EXPECT_GT(outward.size(), 10'000u);
  EXPECT_EQ(outward, contentOf(file("inward/contacts.csv")));
}

TEST_F(GrindCommand, badInputIsOneLineThatNamesIt) {
  folder_.write("empty.stl", "");
  folder_.write("short.csv", "x,y,z,qw,qx,qy,qz\n1,2,3\n");
  folder_.write("a_file", "");
  ASSERT_EQ(runOctoblisk(folder_.path(), "make belt --out round.ply").exit_code, 0);
  const std::pair<const char*, const char*> cases[] = {
      {"--blisk missing.stl --out run", "missing.stl"},
      {"--blisk empty.stl --out run", "empty.stl"},
      {"--path short.csv --out run", "short.csv:2"},
      {"--out a_file/run", "a_file/run"},
      {"--blisk round.ply --out run", "round.ply: no blades were found"},
      {"--ground-blade 99 --out run", "99"}};
  for (const auto& [arguments, named] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.error, StartsWith("octoblisk: "));
    EXPECT_THAT(outcome.error, HasSubstr(named));
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
  EXPECT_EQ(run("").exit_code, 2);
  EXPECT_EQ(run("--max-depth -1 --out run").exit_code, 2);
  EXPECT_EQ(run("--near-miss 0 --out run").exit_code, 2);
  EXPECT_EQ(run("--near-miss nan --out run").exit_code, 2);
  EXPECT_EQ(run("--max-depth nan --out run").exit_code, 2);
  EXPECT_EQ(run("--help").exit_code, 0);
}

}  // namespace
}  // namespace octoblisk::demos
