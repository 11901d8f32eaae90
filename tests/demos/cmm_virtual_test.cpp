// The virtual CMM on known surfaces.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "cmm_shapes.h"
#include "paper/cmm/statistics_map.h"
#include "paper/cmm/virtual_cmm.h"

namespace octoblisk::demos {
namespace {

std::vector<NominalPoint> nominalPoints(const SectionGrid& grid) {
  std::vector<NominalPoint> points;  // away from the border, where the ball would touch beside the surface
  for (std::size_t row = 4; row + 4 < grid.rows(); ++row) {
    for (std::size_t k = 4; k + 4 < grid.stations(); ++k) {
      points.push_back({grid.at(row, k).position, grid.at(row, k).normal});
    }
  }
  return points;
}

ClusteredOctree treeOfGrid(const SectionGrid& grid, const std::vector<double>& displacements) {
  return ClusteredOctree::build(std::make_shared<const TriangleMesh>(grid.displaced(displacements)));
}

SectionGrid wave() {
  return openGrid(40.0, 161, 0.5, 21, [](double x) { return 2.0 * std::sin(0.2 * x); });
}

TEST(VirtualCmm, anOffsetSurfaceIsOffByTheOffset) {
  const SectionGrid grid = wave();
  for (const double offset : {0.0, 0.025, -0.03, 0.5}) {
    const ClusteredOctree part = treeOfGrid(grid, std::vector<double>(grid.size(), offset));
    for (const double deviation : measureDeviations(part, nominalPoints(grid), {.noise = 0.0})) {
      EXPECT_NEAR(deviation, offset, 1e-3 * std::abs(offset) + 5e-5);
    }
  }
}

TEST(VirtualCmm, aFlatIsExact) {
  const SectionGrid grid = plate(40.0, 81, 0.5, 21);
  const ClusteredOctree part = treeOfGrid(grid, std::vector<double>(grid.size(), 0.0234));
  for (const double deviation : measureDeviations(part, nominalPoints(grid), {.noise = 0.0})) {
    EXPECT_NEAR(deviation, 0.0234, 2e-7);
  }
}

// Beside a spike of height h, the ball of radius r rests on its tip: at a distance d it is raised by h - r +
// √(r² - d²).
TEST(VirtualCmm, theBallTouchesBesideThePointWhereSomethingIsHigher) {
  const SectionGrid grid = plate(40.0, 401, 0.1, 101);
  std::vector<double> displacements(grid.size(), 0.0);
  const std::size_t row = 50, station = 200;
  displacements[grid.index(row, station)] = 0.3;
  const ClusteredOctree part = treeOfGrid(grid, displacements);
  const CmmOptions options{.probe_radius = 1.0, .noise = 0.0};
  for (const std::size_t beside : {0u, 1u, 2u, 4u, 6u}) {
    const SectionGrid::Point& nominal = grid.at(row, station + beside);
    const std::vector<NominalPoint> point = {{nominal.position, nominal.normal}};
    const double d = 0.1 * static_cast<double>(beside);
    EXPECT_NEAR(measureDeviations(part, point, options).front(), 0.3 - 1.0 + std::sqrt(1.0 - d * d), 1e-6);
  }
}

TEST(VirtualCmm, noiseIsSeededAndHasItsDeviation) {
  const SectionGrid grid = plate(40.0, 81, 0.5, 21);
  const ClusteredOctree part = treeOfGrid(grid, std::vector<double>(grid.size(), 0.02));
  const CmmOptions options{.noise = 0.0005, .seed = 11};
  const std::vector<double> deviations = measureDeviations(part, nominalPoints(grid), options);
  EXPECT_EQ(deviations, measureDeviations(part, nominalPoints(grid), options));
  EXPECT_NE(deviations, measureDeviations(part, nominalPoints(grid), {.noise = 0.0005, .seed = 12}));
  const ErrorStatistics statistics = statisticsOf(deviations);
  EXPECT_NEAR(statistics.mean, 0.02, 0.0001);
  EXPECT_NEAR(statistics.deviation, 0.0005, 0.00005);
}

TEST(VirtualCmm, saysWhereTheBallMeetsNothing) {
  const SectionGrid grid = plate(40.0, 81, 0.5, 21);
  const ClusteredOctree part = treeOfGrid(grid, std::vector<double>(grid.size(), 0.0));
  const std::vector<NominalPoint> beside = {{Vec3(50.0, 5.0, 0.0), Vec3::UnitZ()}};
  EXPECT_THROW(measureDeviations(part, beside), std::invalid_argument);
  const std::vector<NominalPoint> within = {{Vec3(0.0, 5.0, -1.0), Vec3::UnitZ()}};
  EXPECT_THROW(measureDeviations(part, within), std::invalid_argument);
}

}  // namespace
}  // namespace octoblisk::demos
