// Preston's removal compared with closed forms on a flat plate, and the accuracy of a plan.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cmm_shapes.h"
#include "paper/cmm/grinding_pass.h"

namespace octoblisk::demos {
namespace {

double volumeOf(const SectionGrid& grid, const std::vector<double>& depths) {
  double volume = 0.0;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t k = 0; k < grid.stations(); ++k) {
      volume +=
          depths[grid.index(row, k)] * grid.at(row, k).width * (grid.cellTop(row) - grid.cellBottom(row));
    }
  }
  return volume;
}

std::size_t poseAt(const SectionGrid& grid, std::size_t stroke, double x) {
  return stroke * grid.stations() + stationAt(grid, x);
}

// dV/dt = ∫ K_p p v dA = K_p F v, whatever the pressure's shape.
TEST(CmmGrindingPass, onePoseRemovesPrestonsVolume) {
  const GrindingProcess process;
  for (const int stations : {61, 173, 400}) {
    const SectionGrid grid = plate(60.0, stations, 0.7, 41);
    const GrindingPass pass(grid, process);
    const std::size_t stroke = pass.strokeRows().size() / 2;
    const std::size_t pose = poseAt(grid, stroke, 3.0);
    std::vector<double> dwells(pass.poses(), 0.0);
    dwells[pose] = 0.25;
    const std::vector<double> depths = pass.removal(dwells);
    const double expected = process.preston * 20.0 * process.belt_speed * 0.25;
    EXPECT_NEAR(volumeOf(grid, depths), expected, 1e-9 * expected);
    EXPECT_NEAR(pass.force(pose), 20.0, 1e-9);

    // Without force there is no removal: beyond the wheel's width and the contact's half width.
    const double b = std::sqrt(process.wheel.radius * indentationOnFlat(process.wheel, 20.0));
    const double height = grid.height(pass.strokeRows()[stroke]);
    const double x = grid.at(0, pose % grid.stations()).flat.x();
    std::size_t touched = 0;
    for (std::size_t row = 0; row < grid.rows(); ++row) {
      for (std::size_t k = 0; k < grid.stations(); ++k) {
        const double width = grid.at(row, k).width;
        const bool beyond = std::abs(grid.height(row) - height) > b + 0.35 ||
                            std::abs(grid.at(row, k).flat.x() - x) > 10.0 + width;
        if (beyond) {
          EXPECT_EQ(depths[grid.index(row, k)], 0.0);
        }
        touched += depths[grid.index(row, k)] > 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(touched, 50u);
  }
}

// On a long flat, with an even feed f and strokes s apart: K_p F v / (f s) everywhere, except for the
// strokes' ripple.
TEST(CmmGrindingPass, anEvenFeedOnAFlatRemovesAnEvenDepth) {
  GrindingProcess process;
  process.step_over = 1.0;
  const SectionGrid grid = plate(80.0, 161, 0.5, 61);
  const GrindingPass pass(grid, process);
  const double feed = 10.0;
  const std::vector<double> depths = pass.removal(pass.dwellsOfFeed(feed));
  const double expected = process.preston * 20.0 * process.belt_speed / (feed * 1.0);
  double sum = 0.0;
  int count = 0;
  for (std::size_t row = 12; row <= 48; ++row) {
    for (std::size_t k = stationAt(grid, -25.0); k <= stationAt(grid, 25.0); ++k) {
      const double depth = depths[grid.index(row, k)];
      EXPECT_NEAR(depth, expected, 0.1 * expected);
      sum += depth;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, expected, 0.01 * expected);
}

TEST(CmmGrindingPass, removalIsLinearInDwellForceAndPrestonCoefficient) {
  GrindingProcess process;
  const SectionGrid grid = plate(40.0, 81, 1.0, 15);
  const GrindingPass pass(grid, process);
  const std::vector<double> dwells = pass.dwellsOfFeed(20.0);
  const std::vector<double> depths = pass.removal(dwells);
  const std::vector<double> doubled = pass.removal(pass.dwellsOfFeed(10.0));
  const std::vector<double> lighter = pass.removal(dwells, std::vector<double>(pass.poses(), 0.5));
  process.preston *= 3.0;
  const std::vector<double> sharper = GrindingPass(grid, process).removal(dwells);
  for (std::size_t k = 0; k < depths.size(); ++k) {
    ASSERT_GT(depths[k], 0.0);
    EXPECT_NEAR(doubled[k], 2.0 * depths[k], 1e-12);
    EXPECT_NEAR(lighter[k], 0.5 * depths[k], 1e-12);
    EXPECT_NEAR(sharper[k], 3.0 * depths[k], 1e-12);
  }
}

TEST(CmmGrindingPass, noDwellOrNoForceRemovesNothing) {
  const SectionGrid grid = plate(40.0, 81, 1.0, 15);
  const GrindingPass pass(grid, {});
  const std::vector<double> nothing(pass.poses(), 0.0);
  for (const double depth : pass.removal(nothing)) EXPECT_EQ(depth, 0.0);
  for (const double depth : pass.removal(pass.dwellsOfFeed(20.0), nothing)) EXPECT_EQ(depth, 0.0);
}

// The wanted depths vary more slowly than the wheel is wide, so a plan can reach them away from the edges,
// where strokes are so dense that they leave no ripple.
TEST(CmmGrindingPass, aPlanReachesWhatIsWanted) {
  const SectionGrid grid = plate(160.0, 161, 0.5, 81);
  GrindingProcess process;
  process.step_over = 0.5;
  const GrindingPass pass(grid, process);
  std::vector<double> wanted;
  for (const SectionGrid::Point& point : grid.points()) {
    wanted.push_back(0.02 + 0.004 * std::sin(2.0 * std::numbers::pi * point.flat.x() / 80.0));
  }
  const std::vector<double> dwells = pass.plan(wanted);
  const std::vector<double> depths = pass.removal(dwells);
  for (std::size_t row = 20; row <= 60; ++row) {
    for (std::size_t k = stationAt(grid, -45.0); k <= stationAt(grid, 45.0); ++k) {
      EXPECT_NEAR(depths[grid.index(row, k)], wanted[grid.index(row, k)], 0.001);
    }
  }
  const std::vector<double> slowest = pass.dwellsOfFeed(GrindingProcess{}.least_feed);
  const std::vector<double> fastest = pass.dwellsOfFeed(GrindingProcess{}.greatest_feed);
  for (std::size_t k = 0; k < dwells.size(); ++k) {
    EXPECT_LE(dwells[k], slowest[k] * (1.0 + 1e-12));
    EXPECT_GE(dwells[k], fastest[k] * (1.0 - 1e-12));
  }
}

TEST(CmmGrindingPass, grindingIsRemovalTimesItsErrors) {
  const SectionGrid grid = plate(80.0, 161, 1.0, 25);
  const GrindingPass pass(grid, {});
  const std::vector<double> dwells = pass.dwellsOfFeed(20.0);
  const std::vector<double> model = pass.removal(dwells);
  const std::vector<double> steady =
      pass.grind(dwells, {.preston_factor = 0.8, .force_factor = 1.1, .force_noise = 0.0});
  for (std::size_t k = 0; k < model.size(); ++k) EXPECT_NEAR(steady[k], 0.88 * model[k], 1e-12);

  double noise_of_volume = 0.0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    const ProcessErrors noisy{.preston_factor = 1.0, .force_factor = 1.0, .force_noise = 0.05, .seed = seed};
    const std::vector<double> shaken = pass.grind(dwells, noisy);
    EXPECT_EQ(shaken, pass.grind(dwells, noisy)) << "seeded";
    EXPECT_NE(shaken, model);
    noise_of_volume += volumeOf(grid, shaken) / volumeOf(grid, model) - 1.0;
  }
  // Strokes of about 2000 mm have 200 independent intervals of 10 mm, twice the correlation length: the mean
  // of 16 passes deviates by 0.05 / √3200 or 0.0009.
  EXPECT_NEAR(noise_of_volume / 16, 0.0, 0.003);
}

TEST(CmmGrindingPass, refusesWhatIsNoProcess) {
  const SectionGrid grid = plate(40.0, 41, 1.0, 5);
  for (double GrindingProcess::*parameter : {&GrindingProcess::preston, &GrindingProcess::belt_speed,
                                             &GrindingProcess::step_over, &GrindingProcess::least_feed}) {
    GrindingProcess process;
    process.*parameter = 0.0;
    EXPECT_THROW(GrindingPass(grid, process), std::invalid_argument);
  }
}

}  // namespace
}  // namespace octoblisk::demos
