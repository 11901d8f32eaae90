// octoblisk grind: blisks that are open, shrouded, in any position or inward-facing, and meshes that are not
// blisks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "demos/block.h"
#include "demos/grind_command.h"
#include "demos/moved_blisk.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "io/mesh_file.h"
#include "models/embedded_assets.h"
#include "models/orientation.h"
#include "shared/meshes.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(GrindCommand, aHoleElsewhereChangesNoDepthAndIsReported) {
  const TriangleMesh whole = block({50, 50, 20}, 8);
  std::vector<TriangleMesh::Indices> triangles;
  for (std::size_t t = 0; t < whole.triangleCount(); ++t) {
    const Triangle triangle = whole.triangle(t);
    const bool is_far =
        std::ranges::all_of(triangle, [](const Vec3& v) { return v.x() == -50.0 && v.z() > 9.0; });
    if (!is_far) triangles.push_back(whole.triangles()[t]);
  }
  ASSERT_LT(triangles.size(), whole.triangleCount());
  writeMesh(file("open.ply"), {whole.vertices(), triangles});
  writeMesh(file("tool.ply"), block({10, 10, 10}, 4));
  folder_.write("press.csv", "x,y,z,qw,qx,qy,qz\n59.95,0,0,1,0,0,0\n-59.95,0,15,1,0,0,0\n");
  const Outcome outcome =
      run("--blisk open.ply --belt tool.ply --path press.csv --poses-only --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.error, HasSubstr("edges are open, the first from ("));
  EXPECT_THAT(outcome.error, HasSubstr("are unknown, which counts as interference"));
  const auto table = readTable(file("run/poses.csv"));
  EXPECT_NEAR(std::stod(table.at(0).at("depth_mm")), 0.05, 1e-3);
  EXPECT_EQ(table.at(0).at("verdict"), "interference") << "without blades, every touch is interference";
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
  writeMesh(file("moved.stl"), moved(readMesh(file("z.stl")), blisk_in_mesh));
  std::vector<Pose> path = readPoses(file("z/path.csv"));
  for (Pose& pose : path) pose = blisk_in_mesh * pose;
  writePoses(file("moved.csv"), path);
  const Outcome found = run("--blisk moved.stl --path moved.csv --no-pictures --out found");
  ASSERT_LE(found.exit_code, 1) << found.error;
  EXPECT_THAT(found.out, HasSubstr(" of 20 (intended up to"));
  std::ostringstream axis;
  for (int k = 0; k < 3; ++k) axis << blisk_in_mesh.rotation(k, 2) << ',';
  axis << "300,-150,80";
  const Outcome given =
      run("--blisk moved.stl --path moved.csv --no-pictures --out given --axis " + axis.str());
  ASSERT_LE(given.exit_code, 1) << given.error;

  const auto about_z = readTable(file("z/poses.csv"));
  std::size_t alike = 0, interfering = 0, sides = 0;
  for (const char* folder : {"found", "given"}) {
    const auto table = readTable(file(folder + std::string("/poses.csv")));
    ASSERT_EQ(table.size(), about_z.size());
    for (std::size_t pose = 0; pose < table.size(); ++pose) {
      // Files round to single precision, so a value at a limit may fall to either side.
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
      const bool has_side = std::string(folder) == "given" && table[pose].at("part") == "belt" &&
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
  EXPECT_GT(interfering, alike * 3 / 10);
  EXPECT_LT(interfering, alike * 7 / 10);
  EXPECT_GT(sides, 50u);
  EXPECT_THAT(run("--blisk moved.stl --axis 1,2 --out bad").error, HasSubstr("--axis"));
  EXPECT_EQ(run("--blisk moved.stl --no-pictures --out made").error, "") << "its own path must work too";
}

TEST_F(GrindCommand, aBliskThatFacesInwardGivesTheSameDepths) {
  writeMesh(file("outward.ply"), embeddedBlisk());
  writeMesh(file("inward.ply"), turned(embeddedBlisk()));
  for (const char* kind : {"outward", "inward"}) {
    ASSERT_LE(run("--blisk " + std::string(kind) + ".ply --no-pictures --out " + kind).exit_code, 1);
  }
  const std::string outward = contentOf(file("outward/contacts.csv"));
  EXPECT_GT(outward.size(), 10'000u);
  EXPECT_EQ(outward, contentOf(file("inward/contacts.csv")));
}

TEST_F(GrindCommand, aBliskOfBothWindingsGivesTheSameTablesAndAWarning) {
  const TriangleMesh blisk = embeddedBlisk();
  std::vector<TriangleMesh::Indices> mixed = blisk.triangles();
  for (std::size_t t = 0; t < mixed.size(); t += 2) std::swap(mixed[t][1], mixed[t][2]);
  writeMesh(file("sound.ply"), blisk);
  writeMesh(file("mixed.ply"), TriangleMesh(blisk.vertices(), std::move(mixed)));
  for (const std::string kind : {"sound", "mixed"}) {
    const Outcome outcome =
        run("--blisk " + kind + ".ply --no-pictures --no-report --poses-only --out " + kind);
    ASSERT_EQ(outcome.exit_code, 1);
    const Outcome blades =
        runOctoblisk(folder_.path(), "blades --blisk " + kind + ".ply --no-picture --out of_" + kind);
    ASSERT_EQ(blades.exit_code, 0);
    const bool is_reported = outcome.error.find(
                                 "mixed.ply: 25056 of its 50112 triangles face the opposite way to "
                                 "their neighbours; they are reversed") != std::string::npos;
    EXPECT_EQ(is_reported, kind == "mixed") << outcome.error;
    EXPECT_EQ(blades.error, outcome.error);
    const std::string of_file = " --blisk " + kind + ".ply";
    const Outcome path = runOctoblisk(folder_.path(), "path" + of_file + " --out " + kind + ".csv");
    EXPECT_EQ(path.error, outcome.error);
    const Outcome access = runOctoblisk(
        folder_.path(),
        "access" + of_file + " --rows 2 --columns 3 --tilt-step 60 --no-report --no-picture --out " + kind);
    EXPECT_EQ(access.error, outcome.error);
    const Outcome repair =
        runOctoblisk(folder_.path(), "repair" + of_file + " --path sound.csv --no-report --out of_" + kind);
    EXPECT_EQ(repair.error, outcome.error);
  }
  EXPECT_EQ(contentOf(file("sound.csv")), contentOf(file("mixed.csv")));
  for (const char* table : {"poses.csv", "contacts.csv", "coverage.csv", "points.csv"}) {
    EXPECT_EQ(contentOf(file("sound/" + std::string(table))), contentOf(file("mixed/" + std::string(table))));
  }
  for (const char* table : {"blades.csv", "path.csv", "changes.csv"}) {
    EXPECT_EQ(contentOf(file("of_sound/" + std::string(table))),
              contentOf(file("of_mixed/" + std::string(table))));
  }
}

TEST_F(GrindCommand, aSurfaceOfOneSideIsRefused) {
  // A Möbius strip of eight squares.
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double turn = std::numbers::pi * i / 8.0;
    for (const double w : {-1.0, 1.0}) {
      const double radius = 5.0 + w * std::cos(turn);
      vertices.emplace_back(radius * std::cos(2.0 * turn), radius * std::sin(2.0 * turn), w * std::sin(turn));
    }
    const std::uint32_t a = 2 * i, b = a + 1, c = i == 7 ? 1 : a + 2, d = i == 7 ? 0 : a + 3;
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  writeMesh(file("strip.ply"), TriangleMesh(std::move(vertices), std::move(triangles)));
  expectRefusal(run("--blisk strip.ply --out run"),
                "strip.ply: its triangles cannot be oriented consistently: the surface is one-sided");
}

TEST(Orientation, whatWasTurnedIsTurnedBack) {
  std::mt19937_64 random(130);
  const auto ring = octoblisk::testing::torus(2, 0.8, 16, 10);
  // A block with a cavity, and a separate ring: three parts, each in its orientation or reversed as a whole.
  const TriangleMesh hollow = joined(block({5, 5, 5}, 3), turned(block({2, 2, 2}, 2)));
  const TriangleMesh all = joined(hollow, moved(*ring, Vec3(20, 0, 0)));
  for (int i = 0; i < 20; ++i) {
    std::vector<TriangleMesh::Indices> mixed = all.triangles();
    std::size_t expected = 0;
    for (TriangleMesh::Indices& corners : mixed) {
      if (octoblisk::testing::uniform(random, 0.0, 1.0) > 0.3) continue;
      std::swap(corners[1], corners[2]);
      ++expected;
    }
    std::size_t found = 0;
    const TriangleMesh back = withOneWinding(TriangleMesh(all.vertices(), mixed), found);
    EXPECT_EQ(found, expected);
    for (std::size_t t = 0; t < all.triangleCount(); ++t) {
      EXPECT_GT(scaledNormal(back.triangle(t)).dot(scaledNormal(all.triangle(t))), 0.0);
    }
  }
}

TEST_F(GrindCommand, withoutBladesItWarnsAndCallsThemHubOrShroud) {
  ASSERT_EQ(runOctoblisk(folder_.path(), "make drive-wheel --out round.ply").exit_code, 0);
  // The wheel, 20 mm wide at x = 270 to 330, is not a blisk; the belt's contact wheel is placed in its rim.
  folder_.write("touch.csv", "x,y,z,qw,qx,qy,qz\n335,0,0,1,0,0,0\n");
  const Outcome outcome = run("--blisk round.ply --path touch.csv --no-pictures --out run");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(
      outcome.error,
      "octoblisk: warning: round.ply: no blades were found: every touch counts as interference with hub "
      "or shroud\n");
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("on hub or shroud"));
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["limits"]["ground_blade"].is_null());

  // A tool that may touch the hub: then not every touch is interference.
  ASSERT_EQ(runOctoblisk(folder_.path(), "make grinder --out tool").exit_code, 0);
  std::string edited = contentOf(file("tool/tool.json"));
  edited.replace(edited.find("\"ground\""), 8, std::string("\"hub\""));
  folder_.write("tool/edited.json", edited);
  EXPECT_EQ(run("--blisk round.ply --tool tool/edited.json --path touch.csv --no-pictures --out hub").error,
            "octoblisk: warning: round.ply: no blades were found: all of it is hub or shroud\n");
}

}  // namespace
}  // namespace octoblisk::demos
