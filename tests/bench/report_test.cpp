#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "report/markdown.h"
#include "report/results_page.h"

namespace octoblisk::bench {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Row row(const char* task, const char* scene, const char* contender, double mean, double ratio,
        int differences = 0) {
  return {{"task", task},
          {"scene", scene},
          {"contender", contender},
          {"mean_us", mean},
          {"median_us", mean / 2},
          {"ratio", ratio},
          {"answers_equal", differences == 0},
          {"differences", differences}};
}

TEST(Markdown, roundsToSignificantDigits) {
  EXPECT_EQ(significant(0.4249), "0.42");
  EXPECT_EQ(significant(9.96), "10");
  EXPECT_EQ(significant(32.31), "32");
  EXPECT_EQ(significant(1299.0), "1,300");
  EXPECT_EQ(significant(46080000.0, 4), "46,080,000");
  EXPECT_EQ(significant(-1234.0, 4), "-1,234");
  EXPECT_EQ(significant(0.0), "0");
  EXPECT_EQ(timeText(3.44), "3.4 µs");
  EXPECT_EQ(timeText(178.2), "178 µs");
  EXPECT_EQ(timeText(3300.0), "3.3 ms");
  EXPECT_EQ(timeText(5.3e6), "5.3 s");
  EXPECT_EQ(timeText(999.7), "1.0 ms");
}

TEST(Markdown, tableHasALineARow) {
  MarkdownTable table({"a", "b"});
  EXPECT_TRUE(table.empty());
  table.add({"1", "x|y"});
  EXPECT_EQ(table.text(), "| a | b |\n|---|---|\n| 1 | x\\|y |\n");
  EXPECT_THROW(table.add({"1"}), std::invalid_argument);
  EXPECT_THROW(MarkdownTable({}), std::invalid_argument);
}

TEST(Markdown, splicesBetweenItsLines) {
  EXPECT_EQ(spliced("a\n<!-- t -->\nold\n<!-- end of t -->\nb\n", "t", "new\n"),
            "a\n<!-- t -->\nnew\n<!-- end of t -->\nb\n");
  EXPECT_THROW(spliced("a\n<!-- t -->\n", "t", ""), std::invalid_argument);
  EXPECT_THROW(spliced("a\n", "t", ""), std::invalid_argument);
}

TEST(ResultsPage, showsWhereAPeerWinsAndWhoseAnswersDiffer) {
  const Rows rows = {row("ray", "50k", "octoblisk", 1.5, 1.0), row("ray", "50k", "embree", 0.63, 0.42),
                     row("ray", "300k", "octoblisk", 2.0, 1.0), row("ray", "300k", "fcl", 20.0, 10.0, 3)};
  EXPECT_EQ(taskTable(rows, "ray"),
            "| contender | 50k | 300k |\n|---|---|---|\n| octoblisk | 1.5 µs | 2.0 µs |\n"
            "| embree | 0.63 µs · **0.42** |  |\n| fcl |  | 20 µs · 10 (3 differ) |\n");
  EXPECT_EQ(taskTable(rows, "build"), "");
}

TEST(ResultsPage, listsRowsThatAreLostAndTheirCost) {
  Rows rows = {
      row("ray", "50k", "octoblisk", 1.5, 1.0),          row("ray", "50k", "embree", 0.63, 0.42),
      row("ray", "50k", "bullet-bvh", 9.0, 6.0),         row("ray", "50k", "octoblisk-many", 0.9, 0.6),
      row("world-sphere", "500", "octoblisk", 2.0, 1.0), row("world-sphere", "500", "gimpact", 1.0, 0.5, 7),
      row("ablation-ray", "50k", "octoblisk", 1.5, 1.0), row("ablation-ray", "50k", "leaf-1", 1.2, 0.8)};
  rows[0]["box_tests"] = 8.4;
  rows[0]["leaf_pairs"] = rows[0]["triangle_tests"] = 1.3;
  rows[0]["exact_tests"] = 0.95;
  rows[0]["bytes"] = 5200.0;
  EXPECT_EQ(lostTable(rows),
            "| task | scene | faster | ratio | boxes | leaf pairs | triangle tests | exact tests | bytes |\n"
            "|---|---|---|---|---|---|---|---|---|\n"
            "| ray | 50k | embree | 0.42 | 8.4 | 1.3 | 1.3 | 0.95 | 5,200 |\n"
            "| world-sphere | 500 | gimpact (7 differ) | 0.50 |  |  |  |  |  |\n");
  rows.resize(1);
  EXPECT_EQ(lostTable(rows), "");
}

TEST(ResultsPage, fitsHowFastThingsGrow) {
  Rows rows;
  for (const auto& [scene, size] : {std::pair("100k", 1e5), {"10k", 1e4}, {"1000k", 1e6}, {"belt-2k", 2e3}}) {
    rows.push_back(row("growth-ray", scene, "octoblisk", 0.01 * std::sqrt(size), 1.0));
    rows.back()["size"] = size;
  }
  const Growth growth = {"growth-ray", "", "rays", "triangles"};
  const LogLogPlot plot = growthPlot(rows, growth);
  ASSERT_EQ(plot.curves.size(), 1u);
  EXPECT_EQ(plot.curves[0].x, std::vector<double>({1e4, 1e5, 1e6}));  // sorted, without the rows of belts
  EXPECT_NE(growthTable(plot).find("| octoblisk | 10,000 | 1,000,000 | 1.0 µs | 10 µs | 0.50 |"),
            std::string::npos)
      << growthTable(plot);
  const std::string script = gnuplotScript(plot, "it's.svg");
  EXPECT_NE(script.find("'it''s.svg'"), std::string::npos);
  EXPECT_NE(script.find("octoblisk: ^0.50"), std::string::npos);
  rows[1]["differences"] = 2;
  EXPECT_EQ(growthPlot(rows, growth).curves[0].name, "octoblisk*");
}

TEST(ResultsPage, tellsHowFarOursIsFromTheBound) {
  Rows rows = {row("limit-ray", "50k", "octoblisk", 1.5, 1.0),
               row("limit-ray", "50k", "lower-bound", 0.03, 0.02)};
  rows[0]["bytes"] = 7000.0;
  rows[1]["bytes"] = 36.0;
  rows[0]["exact_tests"] = 0.9;
  rows[1]["exact_tests"] = 0.5;
  EXPECT_NE(limitTable(rows).find("| ray | 50k | 1.5 µs | 0.030 µs | 50 | 0.50 | 0.90 | 36 | 7,000 |"),
            std::string::npos)
      << limitTable(rows);
}

TEST(ResultsPage, showsDynamicsAsATableAndOverTime) {
  const Row ours = {{"task", "dynamics"},
                    {"scene", "tower"},
                    {"contender", "octoblisk"},
                    {"shows", "five cylinders"},
                    {"bodies", 5},
                    {"asleep", 2},
                    {"step_ms", 0.25},
                    {"awake_step_ms", 0.5},
                    {"asleep_after_steps", Row::array({nullptr})},
                    {"late_energy_j", 0.002},
                    {"depth_m", 0.0015},
                    {"points", 20},
                    {"manifolds", 5},
                    {"lost", 1},
                    {"figures", {{"creep_mm", 12.34}, {"top_m", 2.5}}},
                    {"time_s", {0.5, 1.0}},
                    {"energy_j", {3.0, 0.0}},
                    {"depth_over_time_m", {0.01, 0.0015}},
                    {"commit", "1a2b3c4"}};
  Row plane = ours;
  plane["contender"] = "plane";
  plane["asleep_after_steps"] = Row::array({321});
  Row pile = ours;
  pile["scene"] = "pile";
  pile["asleep_after_steps"] = Row::array({500, nullptr, 300, 400, 700});
  const Rows rows = {ours, plane, pile};
  const std::string table = dynamicsTable(rows);
  EXPECT_NE(table.find("| tower | octoblisk | 250 µs | 500 µs | never (2 of 5) | 0.0020 | 1.5 | 20 | 5 | 1 | "
                       "creep_mm 12.3, top_m 2.50 |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| tower | plane | 250 µs | 500 µs | 321 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| pile | octoblisk | 250 µs | 500 µs | 500 (300 to never) |"), std::string::npos)
      << table;
  EXPECT_EQ(dynamicsTable({}), "");

  const ResultsPage page = resultsPage(rows, Row());
  ASSERT_EQ(page.time_plots.size(), 2u);
  EXPECT_TRUE(page.plots.empty());
  EXPECT_EQ(page.time_plots[0].file, "dynamics-tower.svg");
  EXPECT_NE(page.text.find("![tower](dynamics-tower.svg)"), std::string::npos);
  EXPECT_NE(page.text.find("## Machine\n\n- commit: 1a2b3c4\n"), std::string::npos);
  const TimePlot& plot = page.time_plots[0].plot;
  ASSERT_EQ(plot.panels.size(), 2u);
  EXPECT_EQ(plot.panels[0].curves[0].y, std::vector<double>({3.0, 0.0}));
  EXPECT_EQ(plot.panels[1].curves[1].name, "plane");
  const fs::path file = fs::path(::testing::TempDir()) / "dynamics-tower.svg";
  draw(plot, file);
  const std::string svg = textOf(file);
  for (const char* text : {"five cylinders", "kinetic energy, J", "greatest depth, m", "plane"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

/// Every number in the page's table comes from a stored row.
TEST(Results, thePageSaysWhatTheRowsSay) {
  const fs::path source = OCTOBLISK_SOURCE_DIR;
  const Rows rows = readAllRows(source / "bench" / "results");
  ASSERT_FALSE(rows.empty());
  const std::string page = textOf(source / "docs" / "methods.md");
  EXPECT_EQ(spliced(page, "benchmarks", summary(rows, "../bench/results")), page);
}

}  // namespace
}  // namespace octoblisk::bench
