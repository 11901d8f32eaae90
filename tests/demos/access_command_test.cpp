// octoblisk access, run as users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "access/contact_site.h"
#include "demos/command.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "models/blade_finder.h"
#include "models/embedded_assets.h"
#include "toolpath/pose_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;

class AccessCommand : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "access " + arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  ScratchFolder folder_;
};

TEST_F(AccessCommand, freeTiltsOfAGridAreThoseThatGrindDoesNotCallInterference) {
  const std::string grid =
      "--side forward --rows 2 --columns 3 --tilt-from -40 --tilt-to 100 --tilt-step 20 ";
  const Outcome outcome = run(grid + "--out map");
  ASSERT_LE(outcome.exit_code, 1) << outcome.error;
  EXPECT_EQ(outcome.error, "");
  EXPECT_GT(std::filesystem::file_size(file("map/map.png")), 1'000u);
  const auto points = readTable(file("map/points.csv"));
  ASSERT_EQ(points.size(), 6u);
  double area = 0.0, free_area = 0.0;
  for (const auto& row : points) {
    const double of_cell = std::stod(row.at("half_width_mm")) * std::stod(row.at("half_height_mm"));
    area += of_cell;
    if (std::stod(row.at("free_fraction")) > 0.0) free_area += of_cell;
  }
  EXPECT_GT(free_area, 0.0);
  EXPECT_THAT(outcome.out,
              HasSubstr("Can be ground: " + std::to_string(std::lround(100.0 * free_area / area)) +
                        " % of the area"));

  SiteGridOptions options;
  options.forward_side = true;
  options.rows = 2;
  options.columns = 3;
  const TriangleMesh blisk = embeddedBlisk();
  const auto sites = sitesOnBlade(blisk, findBlades(blisk), options);
  std::vector<Pose> poses;
  for (const ContactSite& site : sites) {
    for (int tilt = -40; tilt <= 100; tilt += 20) poses.push_back(tiltedPose(site, tilt, 0.0));
  }
  writePoses(file("poses.csv"), poses);
  ASSERT_LE(runOctoblisk(folder_.path(), "grind --path poses.csv --ground-blade 1 --no-pictures --out judged")
                .exit_code,
            1);
  const auto verdicts = readTable(file("judged/poses.csv"));
  ASSERT_EQ(verdicts.size(), poses.size());
  std::vector<bool> free(poses.size(), false);
  for (const auto& range : readTable(file("map/ranges.csv"))) {
    for (int tilt = std::stoi(range.at("tilt_from_deg")); tilt <= std::stoi(range.at("tilt_to_deg"));
         tilt += 20) {
      free[std::stoul(range.at("point")) * 8 + static_cast<std::size_t>((tilt + 40) / 20)] = true;
    }
  }
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_EQ(free[k], verdicts[k].at("verdict") != "interference")
        << "point " << k / 8 << ", tilt " << k % 8;
  }
  const auto count = std::ranges::count(free, true);
  EXPECT_GE(count, 10);
  EXPECT_LE(count, 40);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto here = std::count(free.begin() + static_cast<std::ptrdiff_t>(8 * p),
                                 free.begin() + static_cast<std::ptrdiff_t>(8 * p + 8), true);
    EXPECT_NEAR(std::stod(points[p].at("free_fraction")), static_cast<double>(here) / 8.0, 1e-9);
  }
  EXPECT_EQ(
      outcome.exit_code,
      std::ranges::any_of(points, [](const auto& row) { return row.at("free_fraction") == "0"; }) ? 1 : 0);

  // One thread must give the same bytes.
  ASSERT_LE(run(grid + "--threads 1 --no-picture --out alone").exit_code, 1);
  for (const char* table : {"points.csv", "ranges.csv"}) {
    EXPECT_EQ(contentOf(file("map") / table), contentOf(file("alone") / table));
  }
  EXPECT_FALSE(std::filesystem::exists(file("alone/map.png")));
}

TEST_F(AccessCommand, ofAPathTakesThePosesThatTouchAndMeasuresTiltsFromThem) {
  ASSERT_LE(runOctoblisk(folder_.path(), "grind --no-pictures --out first").exit_code, 1);
  std::vector<Pose> path = readPoses(file("first/path.csv"));
  path = {path[0], path[100], path[140], path[432]};  // away, two working poses, away
  writePoses(file("four.csv"), path);
  const Outcome outcome = run("--path four.csv --tilt-from -2 --tilt-to 2 --tilt-step 2 --out map");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto points = readTable(file("map/points.csv"));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].at("pose"), "1");
  EXPECT_EQ(points[1].at("pose"), "2");
  for (const auto& point : points) {
    EXPECT_LE(std::stod(point.at("tilt_from_deg")), 0.0) << "the path's own tilt is free";
    EXPECT_GE(std::stod(point.at("tilt_to_deg")), 0.0);
  }
  EXPECT_EQ(contentOf(file("four.csv")), (writePoses(file("same.csv"), path), contentOf(file("same.csv"))));
}

TEST_F(AccessCommand, badInputIsOneLineThatNamesItAndWritesNothing) {
  folder_.write("short.csv", "x,y,z,qw,qx,qy,qz\n1,2,3\n");
  folder_.write("away.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n");
  folder_.write("points.csv", "x,y,z,qw,qx,qy,qz\n300,0,0,1,0,0,0\n");
  ASSERT_EQ(runOctoblisk(folder_.path(), "make grinder --out tool").exit_code, 0);
  std::string more = contentOf(file("tool/tool.json"));
  more.replace(more.find("\"allowed\": ["), 12,
               std::string(R"("allowed": [{"part": "arm", "blade": "hub"},)"));
  folder_.write("tool/more.json", more);
  const std::pair<const char*, const char*> cases[] = {
      {"--blisk missing.stl --out run", "missing.stl"},
      {"--tool tool/more.json --out run",
       "tool/more.json: allowed[0]: access, plan and repair allow only one part to touch"},
      {"--tool tool/none.json --out run", "tool/none.json: no such file"},
      {"--axis 1,2 --out run", "--axis: '1,2' is neither a direction"},
      {"--path short.csv --out run", "short.csv:2"},
      {"--path away.csv --out run", "away.csv"},
      {"--path away.csv --ground-blade 2 --out run", "away.csv"},
      {"--path points.csv --out .", "points.csv: is also an input file"},
      {"--ground-blade 99 --out run", "--ground-blade 99"},
      {"--tilt-from 10 --tilt-to 5 --out run", "--tilt-to"},
      {"--tilt-from -180 --tilt-to 180 --out run", "--tilt-to"},
      {"--lead-from 0 --lead-to 360 --lead-step 0.001 --out run", "--lead-step"}};
  for (const auto& [arguments, named] : cases) {
    expectRefusal(run(arguments), named);
    EXPECT_FALSE(std::filesystem::exists(file("run")));
  }
  for (const char* arguments :
       {"--tilt-step 0 --out run", "--margin -1 --out run", "--rows 0 --out run", "--side left --out run",
        "--max-depth nan --out run", "--threads -1 --out run"}) {
    expectRefusal(run(arguments), "octoblisk: --");
  }
  const std::string help = run("--help").out;
  for (const char* word : {"points.csv", "ranges.csv", "--margin", "mm", "DEG"})
    EXPECT_THAT(help, HasSubstr(word));
}

}  // namespace
}  // namespace octoblisk::demos
