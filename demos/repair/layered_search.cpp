#include "repair/layered_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::demos {
namespace {

constexpr double kBlocked = 1e9;  // beyond the cost of any free way
constexpr double kAvoided = 1e5;  // beyond the cost of a pose and its neighbours

/// For each of a row of values the least of the costs before plus that of the step between; rows are `count`
/// values apart by `stride`. The arg of the least is handed on.
template <typename StepCost>
void relaxRow(const std::vector<double>& values, double most_change, std::size_t first, std::size_t stride,
              const std::vector<double>& cost, const std::vector<std::uint16_t>& before,
              std::vector<double>& new_cost, std::vector<std::uint16_t>& new_before,
              const StepCost& step_cost) {
  std::size_t low = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    while (values[k] - values[low] > most_change + kGridRounding) ++low;
    double least = std::numeric_limits<double>::infinity();
    std::uint16_t from = 0;
    for (std::size_t j = low; j < values.size() && values[j] - values[k] <= most_change + kGridRounding;
         ++j) {
      const double here = cost[first + j * stride] + step_cost(values[k] - values[j]);
      if (here >= least) continue;
      least = here;
      from = before[first + j * stride];
    }
    new_cost[first + k * stride] = least;
    new_before[first + k * stride] = from;
  }
}

}  // namespace

LayeredSearch::LayeredSearch(const ChangeGrid& grid, std::size_t poses)
    : grid_(&grid),
      poses_(poses),
      costs_(grid.size()),
      blocked_(poses * grid.size(), 0),
      least_retract_(poses, 0) {
  for (std::uint32_t node = 0; node < costs_.size(); ++node) costs_[node] = grid.cost(grid.change(node));
}

double LayeredSearch::nodeCost(std::size_t pose, std::uint32_t node) const {
  const bool is_avoided = node % grid_->retracts().size() < least_retract_[pose];
  return costs_[node] + (blocked_[pose * costs_.size() + node] ? kBlocked : 0.0) +
         (is_avoided ? kAvoided : 0.0);
}

// The cost of a step is a sum over the three values, so that each can be gone through by itself.
void LayeredSearch::relaxTilts(Layer& layer) const {
  Layer next = layer;
  const std::size_t stride = grid_->slides().size() * grid_->retracts().size();
  for (std::size_t first = 0; first < stride; ++first) {
    relaxRow(grid_->tilts(), grid_->limits().tilt_per_pose, first, stride, layer.cost, layer.before,
             next.cost, next.before, [&](double change) { return grid_->tiltStepCost(change); });
  }
  layer = std::move(next);
}

void LayeredSearch::relaxSlides(Layer& layer) const {
  Layer next = layer;
  const std::size_t stride = grid_->retracts().size();
  for (std::size_t tilt = 0; tilt < grid_->tilts().size(); ++tilt) {
    for (std::size_t retract = 0; retract < stride; ++retract) {
      relaxRow(grid_->slides(), grid_->limits().slide_per_pose, grid_->node(tilt, 0, retract), stride,
               layer.cost, layer.before, next.cost, next.before,
               [&](double change) { return grid_->slideStepCost(change); });
    }
  }
  layer = std::move(next);
}

void LayeredSearch::relaxRetracts(Layer& layer) const {
  Layer next = layer;
  for (std::size_t first = 0; first < layer.cost.size(); first += grid_->retracts().size()) {
    relaxRow(grid_->retracts(), grid_->limits().retract_per_pose, first, 1, layer.cost, layer.before,
             next.cost, next.before, [&](double change) { return grid_->retractStepCost(change); });
  }
  layer = std::move(next);
}

/// The least over all steps to one node, of which some are blocked.
void LayeredSearch::relaxBlocked(const std::vector<double>& costs, std::uint32_t to,
                                 const std::set<std::uint32_t>& blocked_from, Layer& layer) const {
  const ChangeLimits& limits = grid_->limits();
  const Change target = grid_->change(to);
  layer.cost[to] = std::numeric_limits<double>::infinity();
  for (std::uint32_t from = 0; from < costs.size(); ++from) {
    const Change source = grid_->change(from);
    const double tilt = std::abs(target.tilt - source.tilt);
    const double slide = std::abs(target.slide - source.slide);
    const double retract = std::abs(target.retract - source.retract);
    if (tilt > limits.tilt_per_pose + kGridRounding || slide > limits.slide_per_pose + kGridRounding ||
        retract > limits.retract_per_pose + kGridRounding) {
      continue;
    }
    const double here = costs[from] + grid_->tiltStepCost(tilt) + grid_->slideStepCost(slide) +
                        grid_->retractStepCost(retract) + (blocked_from.contains(from) ? kBlocked : 0.0);
    if (here >= layer.cost[to]) continue;
    layer.cost[to] = here;
    layer.before[to] = static_cast<std::uint16_t>(from);
  }
}

std::vector<std::uint32_t> LayeredSearch::cheapest() const {
  const std::size_t nodes = costs_.size();
  std::vector<std::vector<std::uint16_t>> before(poses_);
  Layer layer{std::vector<double>(nodes), std::vector<std::uint16_t>(nodes)};
  for (std::uint32_t node = 0; node < nodes; ++node) layer.cost[node] = nodeCost(0, node);
  for (std::size_t pose = 1; pose < poses_; ++pose) {
    for (std::uint32_t node = 0; node < nodes; ++node) layer.before[node] = static_cast<std::uint16_t>(node);
    const auto blocked = blocked_steps_.find(pose);
    const std::vector<double> costs = blocked != blocked_steps_.end() ? layer.cost : std::vector<double>{};
    relaxTilts(layer);
    relaxSlides(layer);
    relaxRetracts(layer);
    if (blocked != blocked_steps_.end()) {
      for (const auto& [to, from] : blocked->second) relaxBlocked(costs, to, from, layer);
    }
    for (std::uint32_t node = 0; node < nodes; ++node) layer.cost[node] += nodeCost(pose, node);
    before[pose] = layer.before;
  }
  std::vector<std::uint32_t> way(poses_);
  way.back() = static_cast<std::uint32_t>(std::ranges::min_element(layer.cost) - layer.cost.begin());
  for (std::size_t pose = poses_ - 1; pose > 0; --pose) way[pose - 1] = before[pose][way[pose]];
  return way;
}

}  // namespace octoblisk::demos
