// octoblisk plan, and octoblisk grind of its path.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "demos/command.h"
#include "demos/read_table.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "demos/small_blisk.h"
#include "io/mesh_file.h"
#include "toolpath/cl_motions.h"

namespace octoblisk::demos {
namespace {

class PlanCommand : public ::testing::Test {
 protected:
  PlanCommand() {
    writeMesh(file("blisk.stl"), smallBlisk());
    writeMesh(file("belt.ply"), makeBelt(smallBelt()));
  }
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), arguments); }
  std::filesystem::path file(const std::string& name) const { return folder_.path() / name; }
  ScratchFolder folder_;
};

TEST_F(PlanCommand, writesAPathThatGrindsTheSideAndGrindFindsClean) {
  const std::string inputs = "--blisk blisk.stl --belt belt.ply --threads 2 ";
  const Outcome planned = run("plan " + inputs + "--side concave --out plan");
  ASSERT_EQ(planned.exit_code, 0) << planned.error;
  const Outcome ground =
      run("grind " + inputs + "--path plan/blade-1-concave.csv --no-pictures --no-report --out run");
  EXPECT_EQ(ground.exit_code, 0) << ground.out;

  const auto plan_cells = readTable(file("plan/blade-1-concave-coverage.csv"));
  const auto run_cells = readTable(file("run/coverage.csv"));
  ASSERT_EQ(plan_cells.size(), run_cells.size());
  std::size_t ground_cells = 0;
  for (std::size_t cell = 0; cell < plan_cells.size(); ++cell) {
    const bool is_ground = plan_cells[cell].at("state") == "ground";
    EXPECT_EQ(is_ground, run_cells[cell].at("state") == "ground") << cell;
    ground_cells += is_ground;
  }
  EXPECT_GT(10 * ground_cells, 9 * plan_cells.size());

  double percent = 0.0;
  for (const auto& setup : readTable(file("plan/setups.csv"))) {
    EXPECT_EQ(setup.at("path"), "blade-1-concave.csv");
    percent += std::stod(setup.at("ground_percent"));
  }
  EXPECT_GT(percent, 90.0);
}

TEST_F(PlanCommand, refusesWhatDoesNotFit) {
  const std::string inputs = "plan --blisk blisk.stl --belt belt.ply --out plan ";
  expectRefusal(run(inputs + "--depth 0.1"), "--depth: must be below the depth limit of the belt, 0.1 mm");
  expectRefusal(run(inputs + "--depth 0.05 --scallop 0.06"), "--scallop: must not be above the depth");
  expectRefusal(run(inputs + "--ground-blade 25"), "25");
  expectRefusal(run(inputs + "--ground-blade 2 --all-blades"), "--ground-blade");
  TriangleMesh belt = makeBelt(smallBelt());
  std::vector<Vec3> ahead = belt.vertices();
  for (Vec3& vertex : ahead) vertex.x() += 10.0;
  writeMesh(file("ahead.ply"), TriangleMesh(ahead, belt.triangles()));
  expectRefusal(run("plan --blisk blisk.stl --belt ahead.ply --out plan"),
                "ahead.ply: the belt has no contact wheel at the origin");
}

}  // namespace
}  // namespace octoblisk::demos
