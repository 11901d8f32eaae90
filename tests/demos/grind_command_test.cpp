// octoblisk grind, run as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/moved_blisk.h"
#include "demos/scratch_folder.h"
#include "models/embedded_assets.h"
#include "models/mesh_file.h"
#include "models/orientation.h"
#include "octoblisk/clustered_octree.h"
#include "octoblisk/collide.h"
#include "octoblisk/depth.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// The rows of a table by column name.
std::vector<std::map<std::string, std::string>> readTable(const std::filesystem::path& file) {
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
  EXPECT_EQ(summary["limits"]["ground_blade"], 1);
  EXPECT_THAT(outcome.out, HasSubstr("ground blade 1 of 24 (intended up to 0.1 mm deep)"));

  // Each pose has the worst of its contacts' verdicts, and the runs that interfere are those of the summary.
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
  double depth_on_moves = 0.0;
  for (std::size_t pose = 1; pose < table.size(); ++pose) {
    const double bound = std::stod(table[pose].at("move_depth_at_most_mm"));
    if (touching[pose - 1].contains("belt") && touching[pose].contains("belt")) {
      EXPECT_GT(bound, 0.0) << "pose " << pose;
    }
    depth_on_moves = std::max(depth_on_moves, bound);
  }
  EXPECT_NEAR(summary["moves"]["depth_on_moves_at_most_mm"], depth_on_moves, 1e-6);
  EXPECT_THAT(outcome.out, HasSubstr("\nInterference at poses 20-79, "));

  // The belt alone touches: a sample of its depths, and where pairs of triangles mislead.
  const TriangleMesh belt_mesh = embeddedBeltGrinder().front().mesh;
  const ClusteredOctree belt = treeOf(belt_mesh);
  const octoblisk::Surface blisk_surface(blisk), belt_surface(belt);
  std::set<std::size_t> sample = {227, 232, 233, 234, 328, 374};
  for (std::size_t pose = 5; pose < path.size(); pose += 23) sample.insert(pose);
  DepthQuery query;
  constexpr double kLimit = 0.1, kTolerance = 0.01 * kLimit;
  for (const std::size_t pose : sample) {
    if (!touching[pose].contains("belt")) continue;
    const double of_belt = query.deepest(blisk_surface, belt_surface, path[pose], 0.1 * kTolerance).depth;
    const double of_blisk =
        query.deepest(belt_surface, blisk_surface, path[pose].inverse(), 0.1 * kTolerance).depth;
    EXPECT_NEAR(std::stod(table[pose].at("depth_mm")), of_belt, 1.1 * kTolerance) << "pose " << pose;
    EXPECT_EQ(table[pose].at("verdict"),
              std::max(of_belt, of_blisk) <= kLimit ? "intended contact" : "interference")
        << "pose " << pose;
  }
}

TEST_F(GrindCommand, aPartWhollyInsideTheBliskIsInterference) {
  writeMesh(file("small.ply"), block({3, 3, 3}, 2));
  folder_.write("buried.csv", "x,y,z,qw,qx,qy,qz\n95,0,0,1,0,0,0\n300,0,0,1,0,0,0\n");
  const Outcome outcome = run("--belt small.ply --path buried.csv --out run");
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
    EXPECT_THAT(outcome.error, HasSubstr("block.ply: no blades were found")) << "its edges are none";
    const auto table = readTable(file("run/poses.csv"));
    ASSERT_EQ(table.size(), 3u);
    const double pressed[] = {0.05, 3.0, 9.0};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(std::stod(table[i].at("depth_mm")), pressed[i], 2e-3);
    }
  }
}

TEST_F(GrindCommand, anOpenBliskIsJudgedByPairsAndSaysSo) {
  TriangleMesh whole = block({50, 50, 20}, 2);
  std::vector<TriangleMesh::Indices> triangles = whole.triangles();
  triangles.pop_back();
  writeMesh(file("open.ply"), {whole.vertices(), triangles});
  writeMesh(file("tool.ply"), block({10, 10, 10}, 4));
  folder_.write("press.csv", "x,y,z,qw,qx,qy,qz\n59.95,0,0,1,0,0,0\n");
  const Outcome outcome = run("--blisk open.ply --belt tool.ply --path press.csv --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("open.ply: 3 of its edges are open, the first from ("));
  EXPECT_THAT(outcome.error, HasSubstr("depths are those of pairs of triangles"));
  const auto table = readTable(file("run/poses.csv")), contacts = readTable(file("run/contacts.csv"));
  double deepest = 0.0;
  for (const auto& row : contacts) deepest = std::max(deepest, std::stod(row.at("depth_mm")));
  EXPECT_EQ(std::stod(table.at(0).at("depth_mm")), deepest);
}

TEST_F(GrindCommand, onAClosedBliskTheBuiltInPathLeavesByTheChannelsEnd) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make blisk --triangles 10000 --shroud --out s.ply").exit_code, 0);
  const Outcome outcome = run("--blisk s.ply --poses-only --no-pictures --out run");
  ASSERT_LE(outcome.exit_code, 1) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  std::size_t grinding = 0;
  const auto table = readTable(file("run/poses.csv"));
  for (const auto& row : table) {
    if (row.at("verdict") == "interference") {
      EXPECT_EQ(row.at("part"), "belt") << "not the arm";
      EXPECT_EQ(row.at("blade"), "1") << "not the shroud";
    }
    grinding += row.at("blade") == "1" && std::stod(row.at("depth_mm")) > 0.0;
  }
  EXPECT_GT(grinding, table.size() * 2 / 3);
}

TEST_F(GrindCommand, aBliskThatLiesAnyhowIsJudgedAsTheSameAboutZ) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make blisk --triangles 10000 --blades 20 --out z.stl").exit_code,
            0);
  ASSERT_LE(run("--blisk z.stl --ground-blade 3 --no-pictures --out z").exit_code, 1);
  const Pose blisk_in_mesh{Eigen::AngleAxisd(2.1, Vec3(3, -1, 2).normalized()).toRotationMatrix(),
                           Vec3(300, -150, 80)};
  writeMesh(file("moved.stl"), posed(readMesh(file("z.stl")), blisk_in_mesh));
  std::vector<Pose> path = readPoses(file("z/path.csv"));
  for (Pose& pose : path) pose = blisk_in_mesh * pose;
  writePoses(file("moved.csv"), path);
  const Outcome found = run("--blisk moved.stl --path moved.csv --no-pictures --out found");
  ASSERT_LE(found.exit_code, 1) << found.error;
  EXPECT_THAT(found.out, HasSubstr(" of 20 (intended up to"));
  std::ostringstream axis;
  for (int k = 0; k < 3; ++k) axis << blisk_in_mesh.rotation(k, 2) << ',';
  axis << "300,-150,80";
  const Outcome told =
      run("--blisk moved.stl --path moved.csv --no-pictures --out told --axis " + axis.str());
  ASSERT_LE(told.exit_code, 1) << told.error;

  const auto about_z = readTable(file("z/poses.csv"));
  std::size_t alike = 0, interfering = 0, sides = 0;
  for (const char* folder : {"found", "told"}) {
    const auto table = readTable(file(folder + std::string("/poses.csv")));
    ASSERT_EQ(table.size(), about_z.size());
    for (std::size_t pose = 0; pose < table.size(); ++pose) {
      // Files round to single precision: limits themselves may fall to either side.
      const double depth = std::stod(about_z[pose].at("depth_mm"));
      const double clearance = std::stod(about_z[pose].at("clearance_mm"));
      constexpr double kRounding = 1e-3;
      if (std::abs(depth - 0.1) < 3 * kRounding || std::abs(clearance - 0.5) < kRounding ||
          clearance < kRounding) {
        continue;
      }
      EXPECT_EQ(table[pose].at("verdict"), about_z[pose].at("verdict")) << folder << ", pose " << pose;
      interfering += table[pose].at("verdict") == "interference";
      ++alike;
      const bool has_side = std::string(folder) == "told" && table[pose].at("part") == "belt" &&
                            about_z[pose].at("part") == "belt" && !about_z[pose].at("side").empty() &&
                            table[pose].at("verdict") == "intended contact";
      if (!has_side) continue;
      EXPECT_EQ(table[pose].at("side"), about_z[pose].at("side"));
      EXPECT_EQ(table[pose].at("face"), about_z[pose].at("face"));
      const int blade = std::stoi(table[pose].at("blade"));
      const int first = table[pose].at("side") == "forward" ? blade : blade > 1 ? blade - 1 : 20;
      EXPECT_EQ(table[pose].at("channel"), std::to_string(first) + '-' + std::to_string(first % 20 + 1));
      ++sides;
    }
  }
  EXPECT_GT(alike, about_z.size());
  EXPECT_GT(sides, 50u);
  EXPECT_THAT(run("--blisk moved.stl --axis 1,2 --out bad").error, HasSubstr("--axis"));
  EXPECT_EQ(run("--blisk moved.stl --no-pictures --out made").error, "") << "a path of its own, too";
}

TEST_F(GrindCommand, beltSpeedAndForcesAreInTheTables) {
  ASSERT_LE(run("--no-pictures --poses-only --out first").exit_code, 1);
  std::vector<Pose> path = readPoses(file("first/path.csv"));
  path = {path[0], path[100], path[101], path[140]};
  writePoses(file("four.csv"), path);
  const Outcome outcome =
      run("--path four.csv --ground-blade 1 --belt-speed 25 --spindle --hold 1000 --no-pictures --out run");
  ASSERT_LE(outcome.exit_code, 1) << outcome.error;
  std::size_t of_belt = 0;
  for (const auto& row : readTable(file("run/contacts.csv"))) {
    if (row.at("part") != "belt") {
      EXPECT_EQ(row.at("velocity_x_m_s"), "");
      continue;
    }
    ++of_belt;
    const Vec3 velocity(std::stod(row.at("velocity_x_m_s")), std::stod(row.at("velocity_y_m_s")),
                        std::stod(row.at("velocity_z_m_s")));
    const Vec3 normal(std::stod(row.at("normal_x")), std::stod(row.at("normal_y")),
                      std::stod(row.at("normal_z")));
    const Pose& pose = path[std::stoul(row.at("pose"))];
    EXPECT_NEAR(velocity.norm(), 25.0, 1e-6);
    EXPECT_NEAR(velocity.dot(pose.rotation.col(2)), 0.0, 1e-6) << "square to the wheels' axis";
    EXPECT_LT(std::abs(velocity.dot(normal)), 25.0 * 0.2) << "along the surface";
  }
  EXPECT_GT(of_belt, 3u);
  const auto forces = readTable(file("run/forces.csv"));
  const auto poses = readTable(file("run/poses.csv"));
  ASSERT_EQ(forces.size(), 3u);
  for (const auto& row : forces) {
    const auto& pose = poses[std::stoul(row.at("pose"))];
    const double normal = std::stod(row.at("normal_force_n")),
                 friction = std::stod(row.at("friction_force_n"));
    EXPECT_NEAR(normal, 1000.0 * std::stod(pose.at("depth_mm")), 0.05 * normal);
    EXPECT_NEAR(friction, 0.3 * normal, 0.02 * normal) << "it slides";
    EXPECT_GT(std::abs(std::stod(row.at("torque_n_m"))), 0.1);
  }
  const auto summary = nlohmann::json::parse(contentOf(file("run/summary.json")));
  EXPECT_EQ(summary["forces"]["poses_that_touch"], 3);
  EXPECT_EQ(summary["forces"]["poses_at_which_the_spindle_turns"], 0);
  EXPECT_EQ(summary["parts"][0]["belt_speed_m_s"], 25.0);
  EXPECT_EQ(run("--stiffness 10 --out run").exit_code, 2) << "of no use without --spindle";
}

TEST_F(GrindCommand, cleanPathExitsWithZeroAndPicturesShowIt) {
  folder_.write("away.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n310,0,0,1,0,0,0\n");
  const Outcome outcome = run("--path away.csv --out run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  EXPECT_THAT(outcome.out, HasSubstr("no blade ground (the blisk has 24)"));
  EXPECT_THAT(outcome.out, HasSubstr("2 clear, 0 intended contact, 0 near miss, 0 interference"));
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["limits"]["ground_blade"].is_null());
  EXPECT_THAT(contentOf(file("run/poses.csv")), StartsWith("pose,verdict,part,blade,depth_mm,side,"));
  const auto table = readTable(file("run/poses.csv"));
  ASSERT_EQ(table.size(), 2u);
  for (const auto& row : table) {
    EXPECT_EQ(row.at("verdict"), "clear");
    EXPECT_GT(std::stod(row.at("clearance_mm")), 10.0);
    EXPECT_EQ(std::stod(row.at("depth_mm")), -std::stod(row.at("clearance_mm"))) << "where it is nearest";
    const Vec3 normal(std::stod(row.at("normal_x")), std::stod(row.at("normal_y")),
                      std::stod(row.at("normal_z")));
    EXPECT_NEAR(normal.norm(), 1.0, 1e-6);
  }
  EXPECT_EQ(table[0].at("move"), "");
  EXPECT_EQ(table[1].at("move"), "free");
  EXPECT_EQ(table[1].at("move_fraction"), "1");
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

TEST_F(GrindCommand, withoutBladesItWarnsAndCallsThemHubOrShroud) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make drive-wheel --out round.ply").exit_code, 0);
  // The wheel, 20 mm wide at x = 270 to 330, is no blisk; the belt's contact wheel is put into its rim.
  folder_.write("touch.csv", "x,y,z,qw,qx,qy,qz\n335,0,0,1,0,0,0\n");
  const Outcome outcome = run("--blisk round.ply --path touch.csv --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, StartsWith("octoblisk: warning: round.ply: no blades were found"));
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("on hub or shroud"));
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["limits"]["ground_blade"].is_null());
}

TEST_F(GrindCommand, aMoveThroughABladeIsInterferenceAtClearPoses) {
  // In by the axis of a channel, and round the rim to the next: straight through the blades.
  folder_.write("jump.csv",
                "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n0,300,0,0.7071067811865476,0,0,0.7071067811865476\n");
  const Outcome outcome = run("--path jump.csv --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("2 clear, 0 intended contact, 0 near miss, 0 interference"));
  EXPECT_THAT(outcome.out, HasSubstr("moves that hit what must not be touched: 1,"));
  const auto summary = nlohmann::json::parse(contentOf(file("run/summary.json")));
  EXPECT_EQ(summary["moves"]["hit"], 1);
  EXPECT_EQ(summary["partial"], false);
  const auto table = readTable(file("run/poses.csv"));
  EXPECT_EQ(table.at(1).at("move"), "hit");
  EXPECT_NE(table.at(1).at("move_part"), "");
  const double fraction = std::stod(table.at(1).at("move_fraction"));
  EXPECT_GT(fraction, 0.0);
  EXPECT_LT(fraction, 0.5);

  const Outcome poses_only = run("--path jump.csv --poses-only --no-pictures --out run");
  EXPECT_EQ(poses_only.exit_code, 0);
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["moves"].is_null());
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
  // Its two parts of the belt are what the whole is; the back is half a millimetre off what the contact side
  // touches, and has a margin below that there. No other part comes as near as its margin.
  std::size_t intended = 0;
  for (std::size_t pose = 0; pose < own.size(); ++pose) {
    EXPECT_EQ(own[pose].at("verdict"), built_in[pose].at("verdict")) << "pose " << pose;
    if (own[pose].at("verdict") != "intended contact") continue;
    ++intended;
    EXPECT_EQ(own[pose].at("part"), "belt contact side");
  }
  EXPECT_GT(intended, own.size() / 4);

  // An edited table: the belt may touch nothing.
  std::string edited = contentOf(file("tool/tool.json"));
  edited.replace(edited.find("\"ground\""), 8, std::string("2"));
  folder_.write("tool/edited.json", edited);
  ASSERT_EQ(run("--tool tool/edited.json --poses-only --no-pictures --out edited").exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(contentOf(file("edited/summary.json")))["poses"]["intended_contact"], 0);
  EXPECT_THAT(run("--tool tool/edited.json --ground-blade 3 --out edited").error,
              HasSubstr("no part may touch it"));
  edited.replace(edited.find("\"blade\": 2"), 10, std::string("\"blade\": 99"));
  folder_.write("tool/edited.json", edited);
  EXPECT_THAT(run("--tool tool/edited.json --out edited").error, HasSubstr("blade 99: the blisk has 24"));
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
  EXPECT_THAT(refused.error, HasSubstr("poses.csv: cannot be both read and written"));
  EXPECT_EQ(contentOf(file("poses.csv")), path);
}

TEST_F(GrindCommand, helpTellsWhatTheTablesMean) {
  const std::string help = run("--help").out;
  for (const char* told : {"poses.csv", "contacts.csv", "blade 0 is hub or shroud",
                           "normal points from the part", "not free of it on purpose"}) {
    EXPECT_THAT(help, HasSubstr(told));
  }
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
  for (const char* arguments :
       {"--max-depth -1 --out run", "--max-depth nan --out run", "--max-depth 1e999 --out run",
        "--near-miss 0 --out run", "--near-miss nan --out run", "--near-miss 1e9 --out run", "--out ''",
        "--blisk '' --out run", "--path '' --out run", "--ground-blade 0 --out run"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_THAT(outcome.error, StartsWith("--")) << "names the option";
    EXPECT_LT(outcome.error.find('\n'), 80u) << outcome.error;
  }
  EXPECT_EQ(run("--help").exit_code, 0);
}

}  // namespace
}  // namespace octoblisk::demos
