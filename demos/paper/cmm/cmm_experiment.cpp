#include "paper/cmm/cmm_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace octoblisk::demos {
namespace {

std::vector<double> measure(const CmmExperiment& experiment, std::span<const double> displacements,
                            const CmmOptions& options) {
  const SectionGrid& grid = experiment.strip.grid;
  std::vector<NominalPoint> points;
  for (const MeasuredPoint& point : experiment.points) {
    const SectionGrid::Point& nominal = grid.at(point.row, point.station);
    points.push_back({nominal.position, nominal.normal});
  }
  const auto part = std::make_shared<const TriangleMesh>(grid.displaced(displacements));
  return measureDeviations(ClusteredOctree::build(part), points, options);
}

/// The points that the CMM probes, section by section, starting at the leading edge.
std::vector<MeasuredPoint> measuredPointsOf(const BladeStrip& strip) {
  std::vector<MeasuredPoint> points;
  for (const std::size_t row : strip.measured_rows) {
    for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
      for (const std::size_t station : strip.measured_stations[area]) {
        points.push_back({.row = row, .station = station, .area = kBladeAreas[area]});
      }
    }
  }
  std::sort(points.begin(), points.end(), [](const MeasuredPoint& a, const MeasuredPoint& b) {
    return std::pair(a.row, a.station) < std::pair(b.row, b.station);
  });
  return points;
}

template <typename ErrorOf>
AreaStatistics statisticsByArea(const std::vector<MeasuredPoint>& points, const ErrorOf& errorOf) {
  AreaStatistics statistics;
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    std::vector<double> errors;
    for (const MeasuredPoint& point : points) {
      if (point.area == kBladeAreas[area]) errors.push_back(errorOf(point));
    }
    statistics[area] = statisticsOf(errors);
  }
  return statistics;
}

/// The errors measured before, interpolated over the whole grid: linearly between the points around each
/// measured section, and linearly from section to section.
std::vector<double> measuredEverywhere(const CmmExperiment& experiment) {
  const BladeStrip& strip = experiment.strip;
  const SectionGrid& grid = strip.grid;
  std::vector<std::vector<double>> sections;
  for (const std::size_t row : strip.measured_rows) {
    std::vector<std::pair<double, double>> known;  // position around the section, error
    for (const MeasuredPoint& point : experiment.points) {
      if (point.row == row) known.emplace_back(strip.loopFraction(point.station), point.before);
    }
    const auto [first_part, first_error] = known.front();
    const auto [last_part, last_error] = known.back();
    known.insert(known.begin(), {last_part - 1.0, last_error});
    known.emplace_back(first_part + 1.0, first_error);
    std::vector<double> errors;
    for (std::size_t k = 0; k < grid.stations(); ++k) {
      const double part = strip.loopFraction(k);
      std::size_t after = 1;
      while (after + 1 < known.size() && known[after].first < part) ++after;
      const auto& [from, error_from] = known[after - 1];
      const auto& [to, error_to] = known[after];
      errors.push_back(std::lerp(error_from, error_to, (part - from) / (to - from)));
    }
    sections.push_back(std::move(errors));
  }

  std::vector<double> errors;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    std::size_t above = 1;
    while (above + 1 < sections.size() && strip.measured_rows[above] < row) ++above;
    const double low = grid.height(strip.measured_rows[above - 1]);
    const double high = grid.height(strip.measured_rows[above]);
    const double part = std::clamp((grid.height(row) - low) / (high - low), 0.0, 1.0);
    for (std::size_t k = 0; k < grid.stations(); ++k) {
      errors.push_back(std::lerp(sections[above - 1][k], sections[above][k], part));
    }
  }
  return errors;
}

/// One feed for all poses, such that the mean removal at the measured points is their mean error.
std::vector<double> evenDwells(const CmmExperiment& experiment, const GrindingPass& pass) {
  const std::vector<double> dwells = pass.dwellsOfFeed(1.0);
  const std::vector<double> depths = pass.removal(dwells);
  double error = 0.0;
  double depth = 0.0;
  for (const MeasuredPoint& point : experiment.points) {
    error += point.before;
    depth += depths[experiment.strip.grid.index(point.row, point.station)];
  }
  return pass.dwellsOfFeed(depth / error);
}

PassSummary summaryOf(const GrindingPass& pass, const GrindingProcess& process,
                      const std::vector<double>& dwells) {
  PassSummary summary;
  const ContactWheel& wheel = process.wheel;
  summary.indentation = indentationOnFlat(wheel, process.set_force);
  summary.contact_half_width = std::sqrt(wheel.radius * summary.indentation);
  summary.peak_pressure = 0.5 * wheel.contactModulus() * std::sqrt(summary.indentation / wheel.radius);
  const std::vector<double> slowest = pass.dwellsOfFeed(1.0);
  summary.least_force = summary.least_feed = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < pass.poses(); ++k) {
    summary.least_force = std::min(summary.least_force, pass.force(k));
    summary.greatest_force = std::max(summary.greatest_force, pass.force(k));
    const double feed = slowest[k] / dwells[k];
    summary.least_feed = std::min(summary.least_feed, feed);
    summary.greatest_feed = std::max(summary.greatest_feed, feed);
  }
  summary.strokes = pass.strokeRows().size();
  summary.time = std::accumulate(dwells.begin(), dwells.end(), 0.0);
  return summary;
}

}  // namespace

CmmExperiment runCmmExperiment(const TriangleMesh& blisk, const BladesFound& blades,
                               const CmmExperimentOptions& options) {
  CmmExperiment result{.strip = makeBladeStrip(blisk, blades, options.blade, options.strip)};
  const SectionGrid& grid = result.strip.grid;
  result.stock = makeStock(result.strip, options.stock);
  result.points = measuredPointsOf(result.strip);
  result.stock_at_points = statisticsByArea(result.points, [&](const MeasuredPoint& point) {
    return result.stock[grid.index(point.row, point.station)];
  });

  const std::vector<double> before = measure(result, result.stock, options.cmm);
  for (std::size_t k = 0; k < before.size(); ++k) result.points[k].before = before[k];

  const GrindingPass pass(grid, options.process);
  const std::vector<double> dwells =
      options.plan == PassPlan::measured ? pass.plan(measuredEverywhere(result)) : evenDwells(result, pass);
  const std::vector<double> removed = pass.grind(dwells, options.errors);
  result.ground = result.stock;
  for (std::size_t k = 0; k < removed.size(); ++k) result.ground[k] -= removed[k];
  result.pass = summaryOf(pass, options.process, dwells);

  CmmOptions cmm_after = options.cmm;
  ++cmm_after.seed;
  const std::vector<double> after = measure(result, result.ground, cmm_after);
  for (std::size_t k = 0; k < after.size(); ++k) result.points[k].after = after[k];
  result.before = statisticsByArea(result.points, [](const MeasuredPoint& point) { return point.before; });
  result.after = statisticsByArea(result.points, [](const MeasuredPoint& point) { return point.after; });
  return result;
}

}  // namespace octoblisk::demos
