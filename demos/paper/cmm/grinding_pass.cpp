#include "paper/cmm/grinding_pass.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "paper/cmm/random_field.h"

namespace octoblisk::demos {
namespace {

void requirePositive(double value, const char* name) {
  if (!(value > 0.0 && std::isfinite(value))) {
    throw std::invalid_argument(std::string("the ") + name + " must be above 0");
  }
}

/// ∫ √(1 - t²) dt from 0 to t, with t clamped to [-1, 1].
double areaUnderCircle(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 * (t * std::sqrt((1.0 - t) * (1.0 + t)) + std::asin(t));
}

}  // namespace

GrindingPass::GrindingPass(const SectionGrid& grid, const GrindingProcess& process)
    : grid_(grid), process_(process) {
  requirePositive(process.wheel.radius, "wheel's radius");
  requirePositive(process.wheel.width, "wheel's width");
  requirePositive(process.wheel.shore_a, "cover's hardness");
  requirePositive(100.0 - process.wheel.shore_a, "distance of the cover's hardness from 100");
  requirePositive(process.belt_speed, "belt's speed");
  requirePositive(process.preston, "Preston coefficient");
  requirePositive(process.step_over, "step-over");
  requirePositive(process.least_feed, "least feed");
  requirePositive(process.greatest_feed - process.least_feed, "range of the feed");

  std::size_t row = 0;
  while (true) {
    stroke_rows_.push_back(row);
    for (std::size_t station = 0; station < grid.stations(); ++station) addPose(row, station);
    std::size_t next = row + 1;
    while (next + 1 < grid.rows() && grid.height(next + 1) - grid.height(row) <= process.step_over) ++next;
    if (next >= grid.rows()) break;
    row = next;
  }
}

void GrindingPass::addPose(std::size_t row, std::size_t station) {
  const double indentation = indentationOnFlat(process_.wheel, process_.set_force);
  findContact(grid_, row, station, process_.wheel, indentation, slices_);
  Pose pose{removals_.size(), 0, grid_.at(row, station).width, forceOf(slices_, grid_, row)};
  const double height = grid_.height(row);
  for (const ContactSlice& slice : slices_) {
    const double b = slice.half_width;
    const double peak_rate = process_.preston * process_.belt_speed * slice.peak_pressure * slice.covered;
    const auto removeFrom = [&](std::size_t at) {
      const double bottom = grid_.cellBottom(at) - height;
      const double top = grid_.cellTop(at) - height;
      if (bottom >= b || top <= -b) return false;
      const double rate =
          peak_rate * b * (areaUnderCircle(top / b) - areaUnderCircle(bottom / b)) / (top - bottom);
      removals_.push_back({static_cast<std::uint32_t>(grid_.index(at, slice.station)), rate});
      return true;
    };
    for (std::size_t at = row; at < grid_.rows() && removeFrom(at); ++at) {
    }
    for (std::size_t at = row; at > 0 && removeFrom(at - 1); --at) {
    }
  }
  pose.end = removals_.size();
  poses_.push_back(pose);
}

std::vector<double> GrindingPass::dwellsOfFeed(double feed) const {
  std::vector<double> dwells;
  for (const Pose& pose : poses_) dwells.push_back(pose.step / feed);
  return dwells;
}

std::vector<double> GrindingPass::removal(std::span<const double> dwells,
                                          std::span<const double> loads) const {
  std::vector<double> depths(grid_.size(), 0.0);
  for (std::size_t k = 0; k < poses_.size(); ++k) {
    const double amount = loads.empty() ? dwells[k] : dwells[k] * loads[k];
    for (std::size_t r = poses_[k].first; r < poses_[k].end; ++r) {
      depths[removals_[r].point] += amount * removals_[r].rate;
    }
  }
  return depths;
}

std::vector<double> GrindingPass::weighted(std::span<const double> values) const {
  std::vector<double> sums;
  for (const Pose& pose : poses_) {
    double sum = 0.0;
    for (std::size_t r = pose.first; r < pose.end; ++r) sum += removals_[r].rate * values[removals_[r].point];
    sums.push_back(sum);
  }
  return sums;
}

std::vector<double> GrindingPass::plan(std::span<const double> wanted, int rounds) const {
  std::vector<double> depths(wanted.begin(), wanted.end());
  for (double& depth : depths) depth = std::max(depth, 0.0);
  // Each depth is weighted by the area of its cell; otherwise dense stations would count more.
  std::vector<double> areas;
  for (std::size_t row = 0; row < grid_.rows(); ++row) {
    for (std::size_t k = 0; k < grid_.stations(); ++k) {
      areas.push_back((grid_.cellTop(row) - grid_.cellBottom(row)) * grid_.at(row, k).width);
    }
  }
  const auto weighedByArea = [&](std::vector<double> values) {
    for (std::size_t k = 0; k < values.size(); ++k) values[k] *= areas[k];
    return weighted(values);
  };
  const std::vector<double> aimed = weighedByArea(depths);
  std::vector<double> dwells = dwellsOfFeed(std::sqrt(process_.least_feed * process_.greatest_feed));
  for (int round = 0; round < rounds; ++round) {
    const std::vector<double> reached = weighedByArea(removal(dwells));
    for (std::size_t k = 0; k < dwells.size(); ++k) {
      if (reached[k] > 0.0) dwells[k] *= aimed[k] / reached[k];
      const double step = poses_[k].step;
      dwells[k] = std::clamp(dwells[k], step / process_.greatest_feed, step / process_.least_feed);
    }
  }
  return dwells;
}

std::vector<double> GrindingPass::grind(std::span<const double> dwells, const ProcessErrors& errors) const {
  RandomNumbers random(errors.seed);
  std::vector<double> loads;
  double noise = random.normal();
  for (const Pose& pose : poses_) {
    // A first-order autoregression: the remainder of the previous step's noise, plus fresh noise.
    const double kept = std::exp(-pose.step / errors.force_correlation);
    noise = kept * noise + std::sqrt(1.0 - kept * kept) * random.normal();
    const double force = errors.force_factor * (1.0 + errors.force_noise * noise);
    loads.push_back(errors.preston_factor * std::max(force, 0.0));
  }
  return removal(dwells, loads);
}

}  // namespace octoblisk::demos
