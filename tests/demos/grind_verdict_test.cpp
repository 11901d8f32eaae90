// octoblisk grind: the verdicts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "demos/block.h"
#include "demos/grind_command.h"
#include "demos/read_table.h"
#include "io/mesh_file.h"
#include "models/embedded_assets.h"
#include "models/shared_tree.h"
#include "octoblisk/collide.h"
#include "octoblisk/depth.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

TEST_F(GrindCommand, defaultPathEqualsCollideOfEveryPart) {
  const Outcome outcome = run("--out run --no-pictures");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;  // the default path has poses that interfere
  EXPECT_EQ(outcome.error, "");                      // no progress bar in a pipe
  EXPECT_FALSE(std::filesystem::exists(file("run/overview.png")));
  for (const char* const shown : {"run/report.html", "run/run.glb", "run/contacts.vtk", "run/path.vtk"}) {
    EXPECT_GT(std::filesystem::file_size(file(shown)), 1'000u) << shown;
  }
  EXPECT_THAT(contentOf(file("run/report.html")), HasSubstr("\"title\":\"Interference at "));

  const std::vector<Pose> path = readPoses(file("run/path.csv"));
  std::map<std::size_t, std::set<std::string>> touching;  // parts, by pose
  auto contacts = readTable(file("run/contacts.csv"));
  for (auto& row : contacts) {
    if (std::stod(row.at("depth_mm")) >= 0.0) touching[std::stoul(row.at("pose"))].insert(row.at("part"));
  }

  const auto blisk = treeOf(embeddedBlisk());
  std::size_t hits = 0, clear = 0;
  for (const EmbeddedPart& part : embeddedBeltGrinder()) {
    const auto tree = treeOf(part.mesh);
    for (std::size_t pose = 0; pose < path.size(); ++pose) {
      const bool touches = collide(*blisk, *tree, path[pose]).has_value();
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
  EXPECT_EQ(summary["limits"]["ground_blade"], 1);
  EXPECT_THAT(outcome.out, HasSubstr("ground blade 1 of 24 (intended up to 0.1 mm deep)"));

  // Each pose has the worst of its contacts' verdicts, and the interfering runs match the summary.
  const auto table = readTable(file("run/poses.csv"));
  ASSERT_EQ(table.size(), path.size());
  std::set<std::size_t> interfering, of_contacts, of_summary;
  for (std::size_t pose = 0; pose < table.size(); ++pose) {
    EXPECT_EQ(table[pose].at("pose"), std::to_string(pose));
    if (table[pose].at("verdict") == "interference") interfering.insert(pose);
  }
  for (const auto& row : contacts) {
    const std::size_t pose = std::stoul(row.at("pose"));
    if (row.at("contact_verdict") == "interference") of_contacts.insert(pose);
    EXPECT_NE(table[pose].at("part"), "") << "pose " << pose;
    const bool decides = row.at("contact_verdict") == table[pose].at("verdict");
    if (decides && std::stod(row.at("depth_mm")) >= 0.0) {
      EXPECT_GE(std::stod(table[pose].at("depth_mm")), 0.0) << "pose " << pose;
    }
  }
  for (const auto& range : summary["interfering_poses"]) {
    for (std::size_t pose = range["first"]; pose <= range["last"]; ++pose) of_summary.insert(pose);
  }
  EXPECT_FALSE(interfering.empty());
  EXPECT_EQ(interfering, of_contacts);
  EXPECT_EQ(interfering, of_summary);
  double depth_on_motions = 0.0;
  for (std::size_t pose = 1; pose < table.size(); ++pose) {
    const double bound = std::stod(table[pose].at("motion_depth_at_most_mm"));
    if (touching[pose - 1].contains("belt") && touching[pose].contains("belt")) {
      EXPECT_GT(bound, 0.0) << "pose " << pose;
    }
    depth_on_motions = std::max(depth_on_motions, bound);
  }
  EXPECT_NEAR(summary["motions"]["depth_on_motions_at_most_mm"], depth_on_motions, 1e-6);
  EXPECT_THAT(outcome.out, HasSubstr("\nInterference at poses 20-79, "));

  std::map<std::string, double> areas;
  double area = 0.0;
  for (const auto& row : readTable(file("run/coverage.csv"))) {
    area += std::stod(row.at("area_mm2"));
    areas[row.at("state")] += std::stod(row.at("area_mm2"));
    if (row.at("state") != "ground" && row.at("state") != "too deep") continue;
    const double depth = std::stod(row.at("depth_mm"));
    EXPECT_GE(depth, 0.0);
    EXPECT_EQ(row.at("state"), depth <= 0.1 ? "ground" : "too deep");
    EXPECT_TRUE(touching[std::stoul(row.at("pose"))].contains("belt")) << "or at the previous or next pose";
  }
  ASSERT_EQ(areas.size(), 4u);
  const nlohmann::json& coverage = summary["coverage"];
  EXPECT_NEAR(coverage["ground_share"], areas["ground"] / area, 1e-6);
  EXPECT_NEAR(coverage["too_deep_share"], areas["too deep"] / area, 1e-6);
  EXPECT_NEAR(coverage["left_standing_share"], areas["left standing"] / area, 1e-6);
  EXPECT_NEAR(coverage["not_reached_share"], areas["not reached"] / area, 1e-6);
  const std::string& out = outcome.out;
  std::istringstream shares(out.substr(out.find("\nGround: ") + 1));
  double sum = 0.0;
  for (const char* const name : {"ground", "too deep", "left standing", "not reached"}) {
    std::string words;
    std::getline(shares, words, ':');
    double percent = 0.0;
    shares >> percent;
    EXPECT_NEAR(percent, 100.0 * areas[name] / area, 0.11) << words;
    sum += percent;
  }
  EXPECT_NEAR(sum, 100.0, 1e-9) << out;
  EXPECT_THAT(out, HasSubstr(" % of the convex side of blade 1; too deep: "));
  EXPECT_THAT(out, HasSubstr("\nNot reached: root below 0.4"));
  const std::string ground = out.substr(out.find("\nGround: ") + 1),
                    page = contentOf(file("run/report.html"));
  EXPECT_THAT(page, HasSubstr(" motion. " + ground.substr(0, ground.find('\n')))) << "in the title";
  EXPECT_THAT(page, HasSubstr(R"("region":"convex side of blade 1","shares":[{"name":"ground","percent":)"));

  // Only the belt touches: a sample of its depths, and places where triangle pairs mislead.
  const TriangleMesh belt_mesh = embeddedBeltGrinder().front().mesh;
  const auto belt = treeOf(belt_mesh);
  const octoblisk::Surface blisk_surface(*blisk), belt_surface(*belt);
  std::set<std::size_t> sample = {227, 232, 233, 234, 328, 374};
  for (std::size_t pose = 5; pose < path.size(); pose += 23) sample.insert(pose);
  DepthQuery query;
  constexpr double kLimit = 0.1, kTolerance = 0.01 * kLimit;
  for (const std::size_t pose : sample) {
    if (!touching[pose].contains("belt")) continue;
    const double of_belt = query.deepest(blisk_surface, belt_surface, path[pose], 0.1 * kTolerance).depth;
    const double of_blisk =
        query.deepest(belt_surface, blisk_surface, path[pose].inverse(), 0.1 * kTolerance).depth;
    const double depth = std::max(of_belt, of_blisk);
    EXPECT_NEAR(std::stod(table[pose].at("depth_mm")), depth, 1.1 * kTolerance) << "pose " << pose;
    EXPECT_EQ(table[pose].at("verdict"), depth <= kLimit ? "intended contact" : "interference")
        << "pose " << pose;
  }
}

TEST_F(GrindCommand, thePapersPartitionGivesTheSameContactsAndVerdicts) {
  const std::string common = " --poses-only --no-pictures --no-report";
  ASSERT_EQ(run("--out clustered" + common).exit_code, 1);
  const auto expected = readTable(file("clustered/poses.csv"));
  for (const auto& [option, name] :
       {std::pair("paper", "paper, k_opt, FNOP 8"), std::pair("paper:2:20", "paper, k = 2, FNOP 20")}) {
    const Outcome outcome = run("--out paper --partition " + std::string(option) + common);
    ASSERT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_THAT(outcome.out, HasSubstr("Partition: " + std::string(name) + "; tree built in "));
    EXPECT_EQ(contentOf(file("paper/contacts.csv")), contentOf(file("clustered/contacts.csv")));
    const auto found = readTable(file("paper/poses.csv"));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t pose = 0; pose < found.size(); ++pose) {
      EXPECT_EQ(found[pose].at("verdict"), expected[pose].at("verdict")) << "pose " << pose;
    }
    const auto summary = nlohmann::json::parse(contentOf(file("paper/summary.json")));
    EXPECT_EQ(summary["tree"]["partition"], name);
    EXPECT_GT(summary["tree"]["build_s"], 0.0);
  }
}

TEST_F(GrindCommand, aPartWhollyInsideTheBliskIsInterference) {
  writeMesh(file("small.ply"), block({3, 3, 3}, 2));
  folder_.write("buried.csv", "x,y,z,qw,qx,qy,qz\n95,0,0,1,0,0,0\n300,0,0,1,0,0,0\n");
  const Outcome outcome = run("--belt small.ply --units mm --path buried.csv --out run");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("1 clear, 0 intended contact, 0 near miss, 1 interference"));
  EXPECT_THAT(outcome.out, HasSubstr("belt wholly inside the blisk"));
  const auto table = readTable(file("run/poses.csv"));
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0].at("verdict"), "interference");
  EXPECT_NEAR(std::stod(table[0].at("depth_mm")), 34.0, 0.1);  // amid bore and rim, 60 and 128 mm
}

TEST_F(GrindCommand, theDepthOfATouchIsThatOfTheSolidsHoweverFineTheMeshes) {
  folder_.write("press.csv", "x,y,z,qw,qx,qy,qz\n59.95,0,0,1,0,0,0\n57,0.3,0,1,0,0,0\n51,0,0.1,1,0,0,0\n");
  writeMesh(file("tool.ply"), block({10, 10, 10}, 4));
  for (const int steps : {2, 25}) {
    writeMesh(file("block.ply"), block({50, 50, 20}, steps));
    const Outcome outcome = run("--blisk block.ply --belt tool.ply --path press.csv --no-pictures --out run");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.error, HasSubstr("block.ply: no blades were found"))
        << "edges of a block are not blades";
    const auto table = readTable(file("run/poses.csv"));
    ASSERT_EQ(table.size(), 3u);
    const double pressed[] = {0.05, 3.0, 9.0};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(std::stod(table[i].at("depth_mm")), pressed[i], 2e-3);
    }
  }
}

TEST_F(GrindCommand, aMotionThroughABladeIsInterferenceAtClearPoses) {
  // In along the axis of a channel, and around the rim to the next channel: straight through the blades.
  folder_.write("jump.csv",
                "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n0,300,0,0.7071067811865476,0,0,0.7071067811865476\n");
  const Outcome outcome = run("--path jump.csv --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("2 clear, 0 intended contact, 0 near miss, 0 interference"));
  EXPECT_THAT(outcome.out, HasSubstr("motions that hit a forbidden surface: 1,"));
  const auto summary = nlohmann::json::parse(contentOf(file("run/summary.json")));
  EXPECT_EQ(summary["motions"]["hit"], 1);
  EXPECT_EQ(summary["partial"], false);
  const auto table = readTable(file("run/poses.csv"));
  EXPECT_EQ(table.at(1).at("motion"), "hit");
  EXPECT_NE(table.at(1).at("motion_part"), "");
  const double fraction = std::stod(table.at(1).at("motion_fraction"));
  EXPECT_GT(fraction, 0.0);
  EXPECT_LT(fraction, 0.5);

  const Outcome poses_only = run("--path jump.csv --poses-only --no-pictures --out run");
  EXPECT_EQ(poses_only.exit_code, 0);
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["motions"].is_null());
}

}  // namespace
}  // namespace octoblisk::demos
