// The statistics of a stock, and its sections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "models/blisk.h"
#include "paper/cmm/random_field.h"
#include "paper/cmm/statistics_map.h"
#include "paper/cmm/stock.h"

namespace octoblisk::demos {
namespace {

using std::numbers::pi;

const BladeStrip& defaultStrip() {
  static const Blisk blisk = makeDefaultBlisk();
  static const BladeStrip strip = makeBladeStrip(blisk.mesh, findBlades(blisk.mesh), 1);
  return strip;
}

void expectStatistics(const ErrorStatistics& found, const ErrorStatistics& wanted) {
  EXPECT_NEAR(found.min, wanted.min, 1e-10);
  EXPECT_NEAR(found.max, wanted.max, 1e-10);
  EXPECT_NEAR(found.mean, wanted.mean, 1e-10);
  EXPECT_NEAR(found.deviation, wanted.deviation, 1e-10);
}

TEST(CmmStatistics, areThoseOfASample) {
  const std::vector<double> errors = {1.0, 2.0, 4.0, 5.0};
  const ErrorStatistics statistics = statisticsOf(errors);
  EXPECT_EQ(statistics.min, 1.0);
  EXPECT_EQ(statistics.max, 5.0);
  EXPECT_EQ(statistics.mean, 3.0);
  EXPECT_NEAR(statistics.deviation, std::sqrt(10.0 / 3.0), 1e-15);
  EXPECT_THROW(statisticsOf({errors.data(), 1}), std::invalid_argument);
}

TEST(CmmStatistics, aMapGivesASampleWhatIsAskedFor) {
  RandomNumbers random(7);
  std::vector<double> sample;
  for (int k = 0; k < 60; ++k) sample.push_back(random.normal());
  for (const ErrorStatistics& wanted : kPaperBefore) {
    const StatisticsMap map(sample, wanted);
    std::vector<double> errors;
    for (const double value : sample) errors.push_back(map(value));
    expectStatistics(statisticsOf(errors), wanted);
    for (const double value : sample) EXPECT_NEAR(map(value + 1e-9), map(value), 1e-6) << "continuous";
    double last = map(-5.0);
    for (double value = -5.0; value < 5.0; value += 0.01) {
      EXPECT_GE(map(value), last) << "increasing";
      last = map(value);
    }
  }
}

TEST(CmmStatistics, refusesWhatNoSampleHas) {
  const std::vector<double> sample = {-1.0, -0.5, 0.0, 0.5, 1.0};
  EXPECT_THROW(StatisticsMap(sample, {0.0, 1.0, 0.5, 0.9}), std::invalid_argument);
  EXPECT_THROW(StatisticsMap(sample, {0.0, 1.0, 1.5, 0.3}), std::invalid_argument);
  EXPECT_THROW(StatisticsMap(std::vector<double>{2.0, 2.0}, {0.0, 1.0, 0.5, 0.3}), std::invalid_argument);
}

TEST(CmmRandomField, isNormalSmoothAndClosed) {
  RandomNumbers random(3);
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / 20'000, 0.0, 0.03);
  EXPECT_NEAR(squares / 20'000, 1.0, 0.04);

  double mean_square = 0.0, product = 0.0;
  constexpr int kFields = 2000;
  for (int seed = 0; seed < kFields; ++seed) {
    const SmoothField field(seed, 200.0, 10.0, 15.0);
    EXPECT_NEAR(field.at(0.0, 4.0), field.at(1.0, 4.0), 1e-9);
    mean_square += field.at(0.3, 4.0) * field.at(0.3, 4.0) / kFields;
    product += field.at(0.3, 4.0) * field.at(0.35, 4.0) / kFields;  // 10 mm along
  }
  EXPECT_NEAR(mean_square, 1.0, 0.1);
  EXPECT_NEAR(product, std::exp(-0.5), 0.1) << "at one correlation length";
}

TEST(CmmStock, hasThePapersStatisticsBeforeWhereItIsMeasured) {
  const BladeStrip& strip = defaultStrip();
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::vector<double> stock = makeStock(strip, {.seed = seed});
    ASSERT_EQ(stock.size(), strip.grid.size());
    for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
      std::vector<double> sample;
      for (const std::size_t point : measuredPoints(strip, area)) sample.push_back(stock[point]);
      EXPECT_GE(sample.size(), 50u);
      expectStatistics(statisticsOf(sample), kPaperBefore[area]);
    }
  }
}

TEST(CmmStock, isSmoothSeededAndNowhereBeyondItsExtremes) {
  const BladeStrip& strip = defaultStrip();
  const std::vector<double> stock = makeStock(strip);
  EXPECT_EQ(stock, makeStock(strip));
  EXPECT_NE(stock, makeStock(strip, {.seed = 9}));
  const auto [least, greatest] = std::minmax_element(stock.begin(), stock.end());
  EXPECT_GE(*least, 0.0188);
  EXPECT_LE(*greatest, 0.0290);
  const SectionGrid& grid = strip.grid;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t k = 0; k < grid.stations(); ++k) {
      const std::size_t next = (k + 1) % grid.stations();
      const double length = (grid.at(row, next).flat - grid.at(row, k).flat).norm();
      ASSERT_LT(std::abs(stock[grid.index(row, next)] - stock[grid.index(row, k)]), 0.006 * length + 1e-12);
    }
  }
}

/// One straight blade: an elliptic tube along +x whose middle line is bent by `camber`.
struct Tube {
  static constexpr double kChord = 40.0, kThick = 3.0;

  explicit Tube(double camber, double toward = 1.0) {
    constexpr int kRound = 400, kRows = 60;
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Indices> triangles;
    for (int row = 0; row <= kRows; ++row) {
      for (int k = 0; k < kRound; ++k) {
        const double t = 2.0 * pi * k / kRound;
        const double along = 0.5 * kChord * std::cos(t);
        const double bend = camber * (1.0 - std::pow(std::cos(t), 2));
        vertices.emplace_back(100.0 + row, toward * (bend + 0.5 * kThick * std::sin(t)), along);
      }
    }
    for (std::uint32_t row = 0; row < kRows; ++row) {
      for (std::uint32_t k = 0; k < kRound; ++k) {
        const std::uint32_t a = row * kRound + k, b = row * kRound + (k + 1) % kRound;
        triangles.push_back({a, b, b + kRound});
        triangles.push_back({a, b + kRound, a + kRound});
      }
    }
    mesh = std::make_unique<TriangleMesh>(std::move(vertices), std::move(triangles));
    blades = {.count = 1,
              .blade_of_triangle = std::vector<int>(mesh->triangleCount(), 1),
              .root_radius = 100.0,
              .tip_radius = 160.0};
  }

  std::unique_ptr<TriangleMesh> mesh;
  BladesFound blades;
};

TEST(CmmSection, isTheCurveInWhichACylinderCutsTheBlade) {
  const Tube tube(0.0);
  const BladeSection section = BladeCutter(*tube.mesh, tube.blades, 1).at(130.25);
  for (const auto* side : {&section.forward, &section.backward}) {
    EXPECT_NEAR(side->front().flat.x(), -20.0, 1e-6);
    EXPECT_NEAR(side->back().flat.x(), 20.0, 1e-6);
    for (const SectionPoint& point : *side) {
      EXPECT_NEAR(std::hypot(point.position.x(), point.position.y()), 130.25, 1e-3);
      const double x = point.flat.x() / 20.0;
      const double y = 130.25 * std::sin(point.flat.y() / 130.25) / 1.5;
      EXPECT_NEAR(x * x + y * y, 1.0, 2e-3);
      EXPECT_TRUE(side == &section.forward ? y > -1e-3 : y < 1e-3);
    }
  }
}

TEST(CmmSection, theConvexSideIsWhereTheCamberBulges) {
  const Tube forward(2.0), backward(2.0, -1.0);
  EXPECT_TRUE(convexIsForward(BladeCutter(*forward.mesh, forward.blades, 1).at(130.0)));
  EXPECT_FALSE(convexIsForward(BladeCutter(*backward.mesh, backward.blades, 1).at(130.0)));
}

TEST(CmmSection, refusesWhatHasNoSection) {
  const Tube tube(0.0);
  EXPECT_THROW(BladeCutter(*tube.mesh, tube.blades, 2), std::invalid_argument);
  const BladeCutter cutter(*tube.mesh, tube.blades, 1);
  EXPECT_THROW(cutter.at(50.0), std::invalid_argument);
  EXPECT_THROW(cutter.at(500.0), std::invalid_argument);
  EXPECT_THROW(makeBladeStrip(*tube.mesh, tube.blades, 1, {.span_to = 0.99}), std::invalid_argument);
}

TEST(CmmStrip, itsNormalsPointOutwardsAndItsAreasAreWhereTheyBelong) {
  for (const double toward : {1.0, -1.0}) {
    const Tube tube(2.0, toward);
    const BladeStrip strip = makeBladeStrip(*tube.mesh, tube.blades, 1, {.span_to = 0.8});
    for (std::size_t row = 0; row < strip.grid.rows(); row += 10) {
      for (std::size_t k = 0; k < strip.grid.stations(); ++k) {
        const SectionGrid::Point& point = strip.grid.at(row, k);
        // Outwards from the middle line of the bent ellipse.
        const double x = point.flat.x() / 20.0;
        const double middle = toward * 2.0 * (1.0 - x * x);
        const Vec3 out(0.0, (point.position.y() - middle) / 2.25, point.position.z() / 400.0);
        EXPECT_GT(point.normal.dot(out), 0.0);
        EXPECT_NEAR(point.normal.norm(), 1.0, 1e-12);
        EXPECT_NEAR(point.normal.z(), point.flat_normal.x(), 1e-2);
      }
    }
    const auto middleOf = [&](BladeArea area) {
      const auto& stations = strip.measured_stations[static_cast<std::size_t>(area)];
      return strip.grid.at(0, stations[stations.size() / 2]).flat;
    };
    EXPECT_LT(middleOf(BladeArea::leading_edge).x(), -18.0);
    EXPECT_GT(middleOf(BladeArea::trailing_edge).x(), 18.0);
    EXPECT_GT(toward * (middleOf(BladeArea::convex) - middleOf(BladeArea::concave)).y(), 2.5);
    EXPECT_EQ(strip.measured_rows.size(), 5u);
    EXPECT_NEAR(strip.grid.height(strip.measured_rows.front()), 130.0, 1e-9);
    EXPECT_NEAR(strip.grid.height(strip.measured_rows.back()), 148.0, 1e-9);
  }
}

}  // namespace
}  // namespace octoblisk::demos
