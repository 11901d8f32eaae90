#include "repair/layered_search.h"

#include <algorithm>
#include <limits>

namespace octoblisk::demos {
namespace {

constexpr double kBlocked = 1e10;  // more than the cost of any free route
constexpr double kAvoided = 1e7;   // more than the cost of a pose and its neighbours
constexpr double kLosing = 1e6;    // more than the cost of any change

}  // namespace

LayeredSearch::LayeredSearch(const ChangeGrid& grid, std::size_t poses)
    : grid_(&grid),
      poses_(poses),
      costs_(grid.size()),
      states_(poses * grid.size(), State::free),
      least_retract_(poses, 0),
      before_(poses),
      kept_costs_((poses - 1) / kPosesPerKept + 1) {
  for (std::uint32_t node = 0; node < costs_.size(); ++node) costs_[node] = grid.cost(grid.change(node));
  // The cost of a step is a sum over the three values, so each value can be relaxed separately.
  const ChangeLimits& limits = grid.limits();
  const std::size_t retracts = grid.retracts().size(), slides = grid.slides().size();
  axes_.emplace_back(grid.tilts(), limits.tilt_per_pose, slides * retracts,
                     [&](double change) { return grid.tiltStepCost(change); });
  axes_.emplace_back(grid.slides(), limits.slide_per_pose, retracts,
                     [&](double change) { return grid.slideStepCost(change); });
  axes_.emplace_back(grid.retracts(), limits.retract_per_pose, 1,
                     [&](double change) { return grid.retractStepCost(change); });
}

double LayeredSearch::nodeCost(std::size_t pose, std::uint32_t node) const {
  const bool is_avoided = node % grid_->retracts().size() < least_retract_[pose];
  constexpr double kOfState[] = {0.0, kLosing, kBlocked};
  return costs_[node] + kOfState[static_cast<std::size_t>(states_[pose * costs_.size() + node])] +
         (is_avoided ? kAvoided : 0.0);
}

LayeredSearch::Axis::Axis(const std::vector<double>& values, double most_change, std::size_t apart,
                          const std::function<double(double)>& step_cost)
    : stride(apart) {
  std::size_t low = 0, high = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    while (values[k] - values[low] > most_change + kGridRounding) ++low;
    while (high < values.size() && values[high] - values[k] <= most_change + kGridRounding) ++high;
    steps_to.emplace_back();
    for (std::size_t j = low; j < high; ++j) steps_to.back().push_back({j, step_cost(values[k] - values[j])});
  }
}

/// For each node, the least sum of a cost before and the cost of a step along the axis; passes on the node
/// with the least.
void LayeredSearch::relax(const Axis& axis, Layer& layer, Layer& next) const {
  const std::size_t stride = axis.stride, row = axis.steps_to.size() * stride;
  for (std::size_t first = 0; first < layer.cost.size(); first += row) {
    for (std::size_t k = 0; k < axis.steps_to.size(); ++k) {
      for (std::size_t i = first; i < first + stride; ++i) {
        double least = std::numeric_limits<double>::infinity();
        std::size_t least_from = 0;
        for (const Axis::Step& step : axis.steps_to[k]) {
          const std::size_t from = i + step.from * stride;
          const double here = layer.cost[from] + step.cost;
          if (here >= least) continue;
          least = here;
          least_from = from;
        }
        next.cost[i + k * stride] = least;
        next.before[i + k * stride] = layer.before[least_from];
      }
    }
  }
  std::swap(layer, next);
}

/// The least cost over all steps to one node, some of which are blocked.
void LayeredSearch::relaxBlocked(const std::vector<double>& costs, std::uint32_t to,
                                 const std::set<std::uint32_t>& blocked_from, Layer& layer) const {
  const auto stepsOn = [&](std::size_t axis) -> const std::vector<Axis::Step>& {
    return axes_[axis].steps_to[to / axes_[axis].stride % axes_[axis].steps_to.size()];
  };
  layer.cost[to] = std::numeric_limits<double>::infinity();
  for (const Axis::Step& tilt : stepsOn(0)) {
    for (const Axis::Step& slide : stepsOn(1)) {
      for (const Axis::Step& retract : stepsOn(2)) {
        const std::uint32_t from = grid_->node(tilt.from, slide.from, retract.from);
        const double here = costs[from] + tilt.cost + slide.cost + retract.cost +
                            (blocked_from.contains(from) ? kBlocked : 0.0);
        if (here >= layer.cost[to]) continue;
        layer.cost[to] = here;
        layer.before[to] = static_cast<std::uint16_t>(from);
      }
    }
  }
}

std::vector<std::uint32_t> LayeredSearch::cheapest() {
  const std::size_t nodes = costs_.size();
  Layer layer{std::vector<double>(nodes), std::vector<std::uint16_t>(nodes)};
  Layer next = layer;
  if (searched_ == 0) {
    for (std::uint32_t node = 0; node < nodes; ++node) layer.cost[node] = nodeCost(0, node);
    kept_costs_.front() = layer.cost;
    searched_ = 1;
  }
  const std::size_t kept = (searched_ - 1) / kPosesPerKept;
  layer.cost = kept_costs_[kept];
  for (std::size_t pose = kept * kPosesPerKept + 1; pose < poses_; ++pose) {
    for (std::uint32_t node = 0; node < nodes; ++node) layer.before[node] = static_cast<std::uint16_t>(node);
    const auto blocked = blocked_steps_.find(pose);
    const std::vector<double> costs = blocked != blocked_steps_.end() ? layer.cost : std::vector<double>{};
    for (const Axis& axis : axes_) relax(axis, layer, next);
    if (blocked != blocked_steps_.end()) {
      for (const auto& [to, from] : blocked->second) relaxBlocked(costs, to, from, layer);
    }
    for (std::uint32_t node = 0; node < nodes; ++node) layer.cost[node] += nodeCost(pose, node);
    before_[pose] = layer.before;
    if (pose % kPosesPerKept == 0) kept_costs_[pose / kPosesPerKept] = layer.cost;
  }
  searched_ = poses_;
  std::vector<std::uint32_t> route(poses_);
  route.back() = static_cast<std::uint32_t>(std::ranges::min_element(layer.cost) - layer.cost.begin());
  for (std::size_t pose = poses_ - 1; pose > 0; --pose) route[pose - 1] = before_[pose][route[pose]];
  return route;
}

}  // namespace octoblisk::demos
