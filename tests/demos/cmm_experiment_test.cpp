// The whole experiment: stock, measurement, plan, pass, measurement.
#include "paper/cmm/cmm_experiment.h"

#include <gtest/gtest.h>

#include "demos/default_blisk.h"
#include "models/blisk.h"

namespace octoblisk::demos {
namespace {

CmmExperiment run(const CmmExperimentOptions& options = {}) {
  static const BladesFound blades = findBlades(blisk().mesh);
  return runCmmExperiment(blisk().mesh, blades, options);
}

const CmmExperiment& standard() {
  static const CmmExperiment result = run();
  return result;
}

TEST(CmmExperiment, startsFromThePapersStatistics) {
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    const ErrorStatistics &stock = standard().stock_at_points[area], &wanted = kPaperBefore[area];
    EXPECT_NEAR(stock.min, wanted.min, 1e-10);
    EXPECT_NEAR(stock.max, wanted.max, 1e-10);
    EXPECT_NEAR(stock.mean, wanted.mean, 1e-10);
    EXPECT_NEAR(stock.deviation, wanted.deviation, 1e-10);
    // The CMM's measurement of it: its noise is 0.5 µm.
    const ErrorStatistics& before = standard().before[area];
    EXPECT_NEAR(before.mean, wanted.mean, 0.0002);
    EXPECT_NEAR(before.deviation, wanted.deviation, 0.0003);
    EXPECT_NEAR(before.min, wanted.min, 0.002);
    EXPECT_NEAR(before.max, wanted.max, 0.002);
  }
}

TEST(CmmExperiment, withoutNoiseTheCmmMeasuresTheStock) {
  CmmExperimentOptions options;
  options.cmm.noise = 0.0;
  const CmmExperiment result = run(options);
  // In the hollow between two facets of the blade's mesh, the ball rests beside the point, 0.2 µm too high.
  double sum = 0.0;
  for (const MeasuredPoint& point : result.points) {
    const std::size_t index = result.strip.grid.index(point.row, point.station);
    EXPECT_NEAR(point.before, result.stock[index], 3e-4);
    EXPECT_NEAR(point.after, result.ground[index], 3e-4);
    sum += point.before - result.stock[index];
  }
  EXPECT_NEAR(sum / static_cast<double>(result.points.size()), 0.0, 5e-5);
}

TEST(CmmExperiment, isDeterministic) {
  const CmmExperiment again = run();
  EXPECT_EQ(again.stock, standard().stock);
  EXPECT_EQ(again.ground, standard().ground);
  ASSERT_EQ(again.points.size(), standard().points.size());
  for (std::size_t k = 0; k < again.points.size(); ++k) {
    EXPECT_EQ(again.points[k].before, standard().points[k].before);
    EXPECT_EQ(again.points[k].after, standard().points[k].after);
  }
  CmmExperimentOptions options;
  options.stock.seed = 99;
  EXPECT_NE(run(options).ground, standard().ground);
}

TEST(CmmExperiment, nothingIsAddedAndThePlanTakesOffWhatIsAskedOnTheSides) {
  for (std::size_t k = 0; k < standard().stock.size(); ++k) {
    EXPECT_LE(standard().ground[k], standard().stock[k]);
  }
  CmmExperimentOptions exact;
  exact.errors = {.preston_factor = 1.0, .force_factor = 1.0, .force_noise = 0.0};
  const CmmExperiment ideal = run(exact);
  for (const std::size_t side : {std::size_t{1}, std::size_t{3}}) {
    EXPECT_NEAR(ideal.after[side].mean, 0.0, 0.001);
    EXPECT_LT(ideal.after[side].deviation, ideal.before[side].deviation);
  }
  // If the belt cuts a quarter less than planned, a quarter of the error remains.
  CmmExperimentOptions blunt = exact;
  blunt.errors.preston_factor = 0.75;
  const CmmExperiment left = run(blunt);
  for (const std::size_t side : {std::size_t{1}, std::size_t{3}}) {
    EXPECT_NEAR(left.after[side].mean, 0.25 * left.before[side].mean, 0.001);
  }
}

TEST(CmmExperiment, anEvenPassTakesOffTheMeanErrorByItsModel) {
  CmmExperimentOptions options;
  options.plan = PassPlan::even;
  options.errors = {.preston_factor = 1.0, .force_factor = 1.0, .force_noise = 0.0};
  options.cmm.noise = 0.0;
  const CmmExperiment even = run(options);
  double sum = 0.0;
  for (const MeasuredPoint& point : even.points) sum += point.after;
  EXPECT_NEAR(sum / static_cast<double>(even.points.size()), 0.0, 1e-4);
}

TEST(CmmExperiment, forcesStayWithinTheSetForce) {
  EXPECT_LE(standard().pass.greatest_force, 20.0 * (1.0 + 1e-9));
  EXPECT_GT(standard().pass.greatest_force, 15.0);
  EXPECT_GT(standard().pass.least_force, 0.0);
  EXPECT_GE(standard().pass.least_feed, GrindingProcess{}.least_feed * (1.0 - 1e-9));
  EXPECT_LE(standard().pass.greatest_feed, GrindingProcess{}.greatest_feed * (1.0 + 1e-9));
}

}  // namespace
}  // namespace octoblisk::demos
