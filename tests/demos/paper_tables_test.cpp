// Counts and comparisons in the report on the paper: small cases computed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/number_text.h"
#include "paper/algorithm_chart.h"
#include "paper/comparison_table.h"
#include "paper/detection_seeds.h"
#include "paper/errata.h"
#include "paper/method_table.h"
#include "paper/robot/robot_report.h"
#include "paper/segmentation.h"
#include "paper/spread.h"

namespace octoblisk::demos {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const DetectionTable kHere = {.traditional = {.range = 2e4, .seconds = {1.0, 2.0, 6.0}},
                              .improved = {.range = 1.5e4, .seconds = {1.0, 1.0, 2.5}}};

TEST(PaperComparison, rowsByHand) {
  const Table table = comparisonTable("name", "caption", kHere, kPublishedTable3, 1);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_THAT(table.rows[0], ElementsAre("range (10⁴ mm³)", "all", "2.00", "1.50", "-25.00 %", "4608.00",
                                         "2534.40", "-45.00 %"));
  EXPECT_THAT(table.rows[2],
              ElementsAre("time (s)", "median", "2.0", "1.0", "-50.00 %", "470.62", "382.94", "-18.63 %"));
  EXPECT_THAT(table.rows[3],
              ElementsAre("time (s)", "greatest", "6.0", "2.5", "-58.33 %", "471.35", "383.41", "-18.66 %"));
}

TEST(PaperComparison, claimsAreMeansOverSeedsWithTheirSpread) {
  const DetectionSeeds seeds{
      .range = {0.5, 0.9, 1.0}, .principal_range = {0.4, 0.4, 0.4}, .seconds = {0.9, 1.0, 1.1}};
  const std::vector<Claim> claims = seedsClaims("Table 4", seeds, kPublishedTable4);
  ASSERT_EQ(claims.size(), 2u);
  EXPECT_EQ(claims[0].paper, "-45.0 %");
  EXPECT_EQ(claims[0].here, "-20.0 % (-50.0 % to 0.0 %)");
  EXPECT_EQ(claims[1].paper, "-18.5 %") << "of the medians";
  EXPECT_EQ(claims[1].here, "0.0 % (-10.0 % to +10.0 %)");
  EXPECT_THAT(seedsVerdict(seeds), HasSubstr("to +10.0 %); the sign depends on the seed."));
  EXPECT_THAT(seedsVerdict(seeds), HasSubstr("to 0.0 %). With boxes along principal axes"));
  const Table table = seedsTable("name", "Table 4", seeds);
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_THAT(table.rows[0], ElementsAre("range, boxes along the axes", "-20.0 %", "-50.0 %", "0.0 %"));
}

TEST(PaperSpread, ofOddAndEvenCounts) {
  const Spread odd = spreadOf({3.0, 1.0, 8.0}), even = spreadOf({4.0, 1.0, 2.0, 9.0});
  EXPECT_DOUBLE_EQ(odd.median, 3.0);
  EXPECT_DOUBLE_EQ(odd.mean, 4.0);
  EXPECT_DOUBLE_EQ(even.median, 3.0);
  EXPECT_DOUBLE_EQ(even.least, 1.0);
  EXPECT_DOUBLE_EQ(even.most, 9.0);
}

TEST(PaperPublished, changesThatThePaperPrints) {
  // The last column, row by row, and the gains of Tables 1 and 2 in the text.
  const auto changes = [](const DetectionTable& of) {
    std::vector<std::string> all;
    for (std::size_t run = 0; run < of.traditional.seconds.size(); ++run) {
      all.push_back(changeText(of.traditional.seconds[run], of.improved.seconds[run], 2));
    }
    all.push_back(changeText(spreadOf(of.traditional.seconds).mean, spreadOf(of.improved.seconds).mean, 2));
    return all;
  };
  EXPECT_THAT(changes(kPublishedTable3), ElementsAre("-18.52 %", "-18.66 %", "-18.63 %", "-18.60 %"));
  EXPECT_THAT(changes(kPublishedTable4), ElementsAre("-18.39 %", "-18.44 %", "-18.48 %", "-18.44 %"));
  EXPECT_EQ(kPublishedNodes[0][1] - kPublishedNodes[1][1], 711);
  EXPECT_EQ(changeText(kPublishedNodes[0][1], kPublishedNodes[1][1], 2), "-12.80 %");
  EXPECT_EQ(changeText(kPublishedSeconds[0][1], kPublishedSeconds[1][1], 2), "-40.88 %");
}

TEST(PaperErrata, areFourteenAndComputedFromThePapersTables) {
  const Table table = errataSection().tables.at(0);
  ASSERT_EQ(table.rows.size(), 14u);
  EXPECT_THAT(table.rows[9][2], HasSubstr("k = 2, FNOP 1: 11718; k = 7, FNOP 10: 829; k = 8, FNOP 4: 2286"));
  for (const char* number :
       {"40.88 %", "2.12 ms", "1.42–1.70", "12 %", "in 48", "only 18", "6.95 s", "6.97 s"}) {
    EXPECT_THAT(table.rows[10][2], HasSubstr(number));
  }
  EXPECT_THAT(table.rows[11][2], HasSubstr("2534.40 / 4608.00 = 0.55"));
  EXPECT_DOUBLE_EQ(kPublishedTraditionalRange, 480.0 * 480.0 * 200.0);
}

TEST(MethodTables, theLeastOfAColumn) {
  MethodTable<int> table{};
  for (std::size_t method = 0; method < kMethods; ++method) table[method].fill(10);
  table[0][4] = 1;  // the traditional method must not be chosen
  table[methodOfClusters(5)][4] = 3;
  table[methodOfClusters(7)][4] = 3;
  EXPECT_EQ(bestK(table, 4), 5u) << "the least of equal k";
  EXPECT_EQ(bestK(table, 0), 2u);
  EXPECT_EQ(fnopOf(columnOfFnop(7)), 7u);
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
