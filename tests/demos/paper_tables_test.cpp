// Counts and comparisons in the report on the paper: small cases computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "demos/paper_report.h"
#include "io/number_text.h"
#include "paper/blisk_ranges.h"
#include "paper/detection_experiment.h"
#include "paper/detection_seeds.h"
#include "paper/figures.h"
#include "paper/robot/robot_report.h"
#include "paper/segmentation.h"
#include "paper/split_experiment.h"
#include "paper/stopwatch.h"

namespace octoblisk::demos {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The report of Table 3, of hand-made numbers.
PaperReport reportOfTable3() {
  DetectionResult result{.path_poses = 10, .cloud_points = 100, .holes = {{"boxes", 4, 1}}};
  result.rows.assign(kDetectionMethods, {.method = "method", .range = 1e4, .run_seconds = {1.0}});
  result.rows[kTraditional].range = 2e4;
  result.rows[kTraditional].run_seconds = {1.0, 2.0, 6.0};
  result.rows[kImproved].range = 1.5e4;
  result.rows[kImproved].run_seconds = {1.0, 1.0, 2.5};
  const DetectionSeeds seeds{
      .range = {0.5, 0.9, 1.0}, .principal_range = {0.4, 0.4, 0.4}, .seconds = {0.9, 1.0, 1.1}};
  const BliskRange range{.k = 1, .boxes = 1, .axis_aligned = 1.0, .principal = 1.0};
  const BliskRanges ranges{.whole = range, .at_once = {range}, .by_parts = {range, range}};
  return reportOf("table3", "table3",
                  {{"blades", 24}, {"ranges", ranges}, {"result", result}, {"seeds", seeds}});
}

TEST(PaperReport, table3InThePapersFormByHand) {
  const PaperReport report = reportOfTable3();
  const Table& table = tableOf(report, "table3_paper");
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_THAT(table.rows[0], ElementsAre("range (10⁴ mm³)", "all", "2.00", "1.50", "-25.00 %", "4608.00",
                                         "2534.40", "-45.00 %"));
  EXPECT_THAT(table.rows[2], ElementsAre("time (s)", "median", "2.0000", "1.0000", "-50.00 %", "470.62",
                                         "382.94", "-18.63 %"));
  EXPECT_THAT(table.rows[3], ElementsAre("time (s)", "greatest", "6.0000", "2.5000", "-58.33 %", "471.35",
                                         "383.41", "-18.66 %"));
  EXPECT_THAT(tableOf(report, "table3_holes").rows[0], ElementsAre("boxes", "1 of 4 (25.0 %)"));
}

TEST(PaperReport, claimsAreMeansOverSeedsWithTheirSpread) {
  const PaperReport report = reportOfTable3();
  const Table& claims = tableOf(report, "claims");
  ASSERT_EQ(claims.rows.size(), 3u);
  EXPECT_EQ(claims.rows[0][1], "-45.0 %");
  EXPECT_EQ(claims.rows[0][2], "-20.0 % (-50.0 % to 0.0 %)");
  EXPECT_EQ(claims.rows[1][1], "-18.6 %") << "of the medians";
  EXPECT_EQ(claims.rows[1][2], "0.0 % (-10.0 % to +10.0 %)");
  const std::string& verdict = report.document.sections[2].paragraphs[3];
  EXPECT_THAT(verdict, HasSubstr("to +10.0 %); the sign depends on the seed."));
  EXPECT_THAT(verdict, HasSubstr("to 0.0 %). With boxes along principal axes"));
  const Table& table = tableOf(report, "table3_seeds");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_THAT(table.rows[0], ElementsAre("range, boxes along the axes", "-20.0 %", "-50.0 %", "0.0 %"));
}

/// The report of Table 1 for these nodes in cubes and in principal boxes.
PaperReport reportOfNodes(const MethodTable<std::size_t>& nodes) {
  SplitResult result;
  result.clear = 3;
  for (std::size_t method = 0; method < kMethods; ++method) {
    for (std::size_t column = 0; column < kFnops; ++column) {
      const std::size_t count = nodes[method][column];
      result.cubes[method][column] = {
          .nodes = count, .split_ms = 1.0, .leaf_volume = static_cast<double>(count)};
    }
  }
  result.principal = result.cubes;
  return reportOf("table1", "splits",
                  {{"points", 100}, {"result", result}, {"of_seeds", nlohmann::json::array({result.cubes})}});
}

TEST(PaperReport, kOptIsTheLeastOfAColumn) {
  MethodTable<std::size_t> nodes{};
  for (auto& row : nodes) row.fill(10);
  nodes[0][4] = 1;                // the traditional method must not be chosen
  nodes[4][4] = nodes[6][4] = 3;  // k = 5 and 7
  const PaperReport report = reportOfNodes(nodes);
  const Table& table = tableOf(report, "table1_k_opt");
  EXPECT_EQ(table.rows[0][5], "5") << "the least of equal k";
  EXPECT_EQ(table.rows[0][1], "2");
  EXPECT_EQ(table.rows[1][5], "5") << "by volume";
  EXPECT_THAT(table.rows[2], ElementsAre(HasSubstr("the paper's Table 1"), "2", "2", "2", "8", "4", "4", "7",
                                         "8", "8", "5"));
}

TEST(PaperReport, gainsThatThePaperPrints) {
  MethodTable<std::size_t> nodes{};
  for (auto& row : nodes) row.fill(10);
  const PaperReport report = reportOfNodes(nodes);
  EXPECT_THAT(tableOf(report, "claims").rows[0],
              ElementsAre(HasSubstr("k = 2 and FNOP 2"), "-12.8 %", "0.0 %"));
  EXPECT_THAT(tableOf(report, "table1_nodes").rows[4],
              ElementsAre("k = 2, paper", "11718*", "4842", "3154", "2402", "1954", "1506", "1298", "1130",
                          "1026", "970"));
  ASSERT_EQ(report.more_tables.size(), 1u);
  EXPECT_EQ(report.more_tables[0].rows.size(), 2 * kMethods * kFnops);
}

TEST(PaperReport, refusesMissingNumbers) {
  EXPECT_THROW(reportOf("table3", "table3", {{"blades", 24}}), std::logic_error);
}

TEST(PaperReport, errataAreFourteenAndComputedFromThePapersTables) {
  const PaperReport report = reportOf("none", "none", nullptr);
  const Table& table = tableOf(report, "errata");
  ASSERT_EQ(table.rows.size(), 14u);
  EXPECT_THAT(table.rows[9][2], HasSubstr("k = 2, FNOP 1: 11718; k = 7, FNOP 10: 829; k = 8, FNOP 4: 2286."));
  for (const char* number :
       {"40.88 %", "2.12 ms", "1.42–1.70", "12 %", "in 48", "only 18", "6.95 s", "6.97 s"}) {
    EXPECT_THAT(table.rows[10][2], HasSubstr(number));
  }
  EXPECT_THAT(table.rows[11][2], HasSubstr("2534.40 / 4608.00 = 0.55"));
}

TEST(Median, ofOddAndEvenCounts) {
  EXPECT_DOUBLE_EQ(medianOf({3.0, 1.0, 8.0}), 3.0);
  EXPECT_DOUBLE_EQ(medianOf({4.0, 1.0, 2.0, 9.0}), 3.0);
}

TEST(NumberTexts, sharesOfAWhole) {
  EXPECT_EQ(partText(3, 40), "3 of 40 (7.5 %)");
  EXPECT_EQ(partText(0, 0), "0 of 0");
  EXPECT_EQ(changeText(200.0, 199.99), "0.0 %") << "not -0.0 %";
}

TEST(PaperParts, eachIsClusteredByItself) {
  const auto pairAt = [](double x) { return Points{Vec3(x, 0, 0), Vec3(x + 1, 0, 0)}; };
  const std::vector<Points> parts = {pairAt(0), pairAt(100), {Vec3(200, 0, 0)}};
  EXPECT_EQ(clustersOfParts(parts, {.k = 1}), parts);
  EXPECT_EQ(clustersOfParts(parts, {.k = 2}).size(), 5u) << "a single point is one cluster";
  EXPECT_EQ(clustersOfParts(parts, {.k = 2}), clustersOfParts(parts, {.k = 2}));
  EXPECT_EQ(joined(parts).size(), 5u);
  EXPECT_EQ(joined(parts)[4], Vec3(200, 0, 0));
}

TEST(RobotTotals, ofTwoRunsByHand) {
  std::vector<RobotRun> runs(2);
  for (std::size_t run = 0; run < 2; ++run) {
    runs[run].ticks.resize(10 * (run + 1));
    runs[run].touching_ticks = 4 + run;
    RobotMethodResult& exact = runs[run].methods[static_cast<std::size_t>(RobotMethod::exact)];
    exact.mean_seconds = 1.0 + static_cast<double>(run);
    exact.worst_seconds = 7.0 - static_cast<double>(run);
    exact.touch = {.alarms = 5, .missed = run, .false_alarms = 1};
    exact.forbidden = RobotAlarms{.alarms = 2, .missed = 0, .false_alarms = 2};
  }
  const RobotTotals totals = totalsOf(runs, RobotMethod::exact);
  EXPECT_EQ(totals.ticks, 30u);
  EXPECT_EQ(totals.touching, 9u);
  EXPECT_DOUBLE_EQ(totals.mean_seconds, 1.5);
  EXPECT_DOUBLE_EQ(totals.worst_seconds, 7.0);
  EXPECT_EQ(totals.touch.alarms, 10u);
  EXPECT_EQ(totals.touch.missed, 1u);
  EXPECT_EQ(totals.wrong.false_alarms, 4u);
  EXPECT_EQ(totalsOf(runs, RobotMethod::traditional).wrong.alarms, 0u);
}

TEST(AlgorithmChart, hasEveryStepAndNoBoxOverAnother) {
  const FlowChart chart = algorithmChart();
  const std::string svg = svgOf(chart);
  for (const char* words : {"principal", "k-means", "octree", "axes (eq. 11)", ">yes<", ">no<", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
  for (std::size_t i = 0; i < chart.boxes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const FlowBox &a = chart.boxes[i], &b = chart.boxes[j];
      EXPECT_TRUE(a.row != b.row || std::abs(a.column - b.column) >= 1.0) << a.text << " / " << b.text;
    }
  }
}

}  // namespace
}  // namespace octoblisk::demos
