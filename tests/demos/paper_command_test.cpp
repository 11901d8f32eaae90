// octoblisk paper, run as users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "demos/block.h"
#include "demos/command.h"
#include "demos/refusal.h"
#include "demos/scratch_folder.h"
#include "io/mesh_file.h"

namespace octoblisk::demos {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PaperCommand : public ::testing::Test {
 protected:
  /// A slab, which is treated as a single blade.
  PaperCommand() { writeMesh(folder_.path() / "slab.stl", block({40.0, 25.0, 2.0}, 6)); }
  Outcome run(const std::string& arguments) { return runOctoblisk(folder_.path(), "paper " + arguments); }
  std::string content(const std::string& name) const { return contentOf(folder_.path() / name); }

  ScratchFolder folder_;
};

TEST_F(PaperCommand, tablesOfABladeAreTheSameAgain) {
  for (const std::string out : {"one", "two"}) {
    const Outcome outcome = run("table1 --blade slab.stl --points 100 --out " + out);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.out, "Report: " + out + "/report.html, " + out + "/report.md\n");
  }
  const std::string nodes = content("one/table1_nodes.csv");
  EXPECT_EQ(std::ranges::count(nodes, '\n'), 1 + 3 * 8);
  EXPECT_THAT(nodes, StartsWith("FNOP,1,2,3,4,5,6,7,8,9,10\n\"traditional, here\","));
  EXPECT_THAT(nodes, HasSubstr("\"k = 2, paper\",11718*,4842,3154,"));
  EXPECT_EQ(nodes, content("two/table1_nodes.csv"));
  EXPECT_EQ(content("one/report.md"), content("two/report.md")) << "Table 1 has no times";
  EXPECT_THAT(content("one/report.md"), HasSubstr("# The paper's experiments, rerun"));
  EXPECT_THAT(content("one/report.md"), HasSubstr("## Errata"));
  EXPECT_EQ(std::ranges::count(content("one/split_cells.csv"), '\n'), 1 + 2 * 80);
}

TEST_F(PaperCommand, allOfABladeAloneLeavesTable3OutAndSaysSo) {
  const Outcome outcome = run("all --blade slab.stl --points 100 --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_THAT(outcome.error, StartsWith("octoblisk: warning: slab.stl: no blades were found"));
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1);
  const std::string page = content("out/report.html");
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("data:image/svg+xml;base64,"));
  EXPECT_THAT(page, HasSubstr("Table 2: split time"));
  EXPECT_EQ(std::ranges::count(content("out/claims.csv"), '\n'), 1 + 4) << "two of Table 1, two of Table 2";
  EXPECT_THAT(page, Not(HasSubstr("Table 3: detection")));
  for (const std::string file :
       {"fig2.png", "fig4a.png", "fig5b.png", "fig7.svg", "fig8g.png", "fig9.svg", "fig10.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out" / file)) << file;
  }
}

TEST_F(PaperCommand, table3OfTheBuiltInBlisk) {
  const Outcome outcome = run("table3 --points 100 --out out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::string paper = content("out/table3_paper.csv");
  // The paper's range is that of the built-in blisk: 480 x 480 x 200 mm.
  EXPECT_THAT(paper, HasSubstr(",4608.00,2534.40,-45.00 %\n"));
  EXPECT_THAT(content("out/table3_methods.csv"), HasSubstr("one box along the axes,4608.00,"));
  EXPECT_THAT(content("out/report.md"),
              HasSubstr("The exact rows differ from the triangles' verdict at 0 poses."));
  EXPECT_THAT(content("out/blisk_ranges.csv"), HasSubstr("\"parts, then k = 2 each\",50,"));
  EXPECT_THAT(content("out/report.md"), HasSubstr("replay.html, beside this report"));
  EXPECT_THAT(content("out/replay.html"), HasSubstr("\"command\":\"paper table3\""));
}

TEST_F(PaperCommand, whatFailsLeavesNoFolder) {
  // A mesh without area has no points, which is only found after the folder is created.
  folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  std::filesystem::create_directory(folder_.path() / "kept");
  for (const std::string out : {"new", "kept"}) {
    const Outcome outcome = run("table1 --blade flat.obj --points 100 --out " + out);
    expectRefusal(outcome, "octoblisk: flat.obj: ");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "kept"));
}

TEST_F(PaperCommand, badInputIsReportedInOneLine) {
  folder_.write("text.stl", "no mesh at all");
  folder_.write("file", "");
  const std::pair<std::string, std::string> cases[] = {
      {"table1 --blade none.stl --out out", "octoblisk: none.stl: "},
      {"all --blade text.stl --out out", "octoblisk: text.stl: "},
      {"table3 --blade slab.stl --out out", "octoblisk: slab.stl: no blades were found about the z axis"},
      {"table4 --blade slab.stl --out out", "octoblisk: slab.stl: no blades were found about the z axis"},
      {"table1 --blade slab.stl --points 100 --out file/out",
       "octoblisk: file/out: cannot create the folder"},
      {"table6 --out out", "octoblisk: 'table6' is not a subcommand; did you mean 'table1'?"}};
  for (const auto& [arguments, message] : cases) {
    const Outcome outcome = run(arguments);
    expectRefusal(outcome, message);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out")) << arguments;
  }
  for (const std::string arguments : {"table1 --points 99 --out out", "table1 --points 10001 --out out",
                                      "table1 --seed -1 --out out", "table1 --out ''", "table1", ""}) {
    EXPECT_EQ(run(arguments).exit_code, 2) << arguments;
  }
}

}  // namespace
}  // namespace octoblisk::demos
