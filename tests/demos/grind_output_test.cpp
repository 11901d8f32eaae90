// octoblisk grind: its tables and pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "demos/grind_command.h"
#include "demos/read_table.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST_F(GrindCommand, cleanPathExitsWithZeroAndPicturesShowIt) {
  folder_.write("away.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n310,0,0,1,0,0,0\n");
  const Outcome outcome = run("--path away.csv --out run");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::string warning = "octoblisk: warning: away.csv: the belt touches no blade at any pose: ";
  EXPECT_THAT(outcome.error, StartsWith(warning));
  EXPECT_THAT(runOctoblisk(folder_.path(), "repair --path away.csv --no-report --out mended").error,
              StartsWith(warning));
  EXPECT_THAT(outcome.out, HasSubstr("no blade ground (the blisk has 24)"));
  EXPECT_THAT(outcome.out, HasSubstr("2 clear, 0 intended contact, 0 near miss, 0 interference"));
  EXPECT_TRUE(nlohmann::json::parse(contentOf(file("run/summary.json")))["limits"]["ground_blade"].is_null());
  EXPECT_THAT(contentOf(file("run/poses.csv")), StartsWith("pose,verdict,part,blade,depth_mm,side,"));
  const auto table = readTable(file("run/poses.csv"));
  ASSERT_EQ(table.size(), 2u);
  for (const auto& row : table) {
    EXPECT_EQ(row.at("verdict"), "clear");
    EXPECT_GT(std::stod(row.at("clearance_mm")), 10.0);
    EXPECT_EQ(std::stod(row.at("depth_mm")), -std::stod(row.at("clearance_mm"))) << "at the nearest point";
    const Vec3 normal(std::stod(row.at("normal_x")), std::stod(row.at("normal_y")),
                      std::stod(row.at("normal_z")));
    EXPECT_NEAR(normal.norm(), 1.0, 1e-6);
  }
  EXPECT_EQ(table[0].at("motion"), "");
  EXPECT_EQ(table[1].at("motion"), "free");
  EXPECT_EQ(table[1].at("motion_fraction"), "1");
  EXPECT_GT(std::filesystem::file_size(file("run/overview.png")), 10'000u);
  EXPECT_GT(std::filesystem::file_size(file("run/closeup.png")), 1'000u);
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
    EXPECT_NEAR(velocity.dot(pose.rotation.col(2)), 0.0, 1e-6) << "perpendicular to the wheels' axis";
    EXPECT_LT(std::abs(velocity.dot(normal)), 25.0 * 0.2) << "along the surface";
  }
  EXPECT_GT(of_belt, 3u);
  const auto forces = readTable(file("run/forces.csv"));
  const auto poses = readTable(file("run/poses.csv"));
  ASSERT_EQ(forces.size(), 3u);
  for (const auto& row : forces) {
    const auto& pose = poses[std::stoul(row.at("pose"))];
    EXPECT_EQ(row.at("verdict"), pose.at("verdict"));
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
  EXPECT_EQ(run("--stiffness 10 --out run").exit_code, 2) << "--stiffness needs --spindle";
}

TEST_F(GrindCommand, helpExplainsTheTables) {
  const std::string help = run("--help").out;
  for (const char* word : {"poses.csv", "contacts.csv", "blade 0 is hub or shroud", "on purpose"}) {
    EXPECT_THAT(help, HasSubstr(word));
  }
}

}  // namespace
}  // namespace octoblisk::demos
