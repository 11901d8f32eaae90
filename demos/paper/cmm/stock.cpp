#include "paper/cmm/stock.h"

#include <stdexcept>

#include "paper/cmm/random_field.h"

namespace octoblisk::demos {

std::vector<std::size_t> measuredPoints(const BladeStrip& strip, std::size_t area) {
  std::vector<std::size_t> points;
  for (const std::size_t row : strip.measured_rows) {
    for (const std::size_t station : strip.measured_stations[area]) {
      points.push_back(strip.grid.index(row, station));
    }
  }
  return points;
}

std::vector<double> makeStock(const BladeStrip& strip, const StockOptions& options) {
  if (!(options.correlation_along > 0.0 && options.correlation_up > 0.0)) {
    throw std::invalid_argument("the correlation lengths of the stock must be above 0 mm");
  }
  const SectionGrid& grid = strip.grid;
  const SmoothField field(options.seed, grid.length(grid.rows() / 2), options.correlation_along,
                          options.correlation_up);
  std::vector<double> values;
  for (std::size_t row = 0; row < grid.rows(); ++row) {
    for (std::size_t k = 0; k < grid.stations(); ++k) {
      values.push_back(field.at(strip.loopFraction(k), grid.height(row)));
    }
  }

  std::vector<StatisticsMap> maps;
  for (std::size_t area = 0; area < kBladeAreas.size(); ++area) {
    std::vector<double> sample;
    for (const std::size_t point : measuredPoints(strip, area)) sample.push_back(values[point]);
    maps.emplace_back(sample, options.statistics[area]);
  }
  std::vector<double> errors(values.size(), 0.0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const BladeStrip::Shares& shares = strip.shares[k % grid.stations()];
    for (std::size_t area = 0; area < maps.size(); ++area) {
      if (shares[area] > 0.0) errors[k] += shares[area] * maps[area](values[k]);
    }
  }
  return errors;
}

}  // namespace octoblisk::demos
