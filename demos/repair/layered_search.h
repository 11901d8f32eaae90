// Finds the cheapest route through layers of nodes, one layer per pose, with small changes from layer to
// layer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "repair/change_grid.h"

namespace octoblisk::demos {

/// Dynamic programming over the poses of a path. Every node counts as free until it is marked as blocked. The
/// route may still use a blocked node or step, at more than the cost of all free ones together: so it uses as
/// few of them as possible. Among such routes it has the fewest nodes that lose contact, and among those the
/// least cost.
class LayeredSearch {
 public:
  /// The grid must outlive it. `poses` is at least 1.
  LayeredSearch(const ChangeGrid& grid, std::size_t poses);

  void blockNode(std::size_t pose, std::uint32_t node) {
    states_[pose * grid_->size() + node] = State::blocked;
    noteChange(pose);
  }

  /// Marks a node where the tool loses its contact.
  void markLosing(std::size_t pose, std::uint32_t node) {
    State& state = states_[pose * grid_->size() + node];
    state = std::max(state, State::losing);
    noteChange(pose);
  }

  /// Blocks the step from a node to a node of the next pose, which is `pose`.
  void blockStep(std::size_t pose, std::uint32_t from, std::uint32_t to) {
    blocked_steps_[pose][to].insert(from);
    noteChange(pose);
  }

  /// Removes all blocks of steps to a pose.
  void unblockSteps(std::size_t pose) {
    blocked_steps_.erase(pose);
    noteChange(pose);
  }

  /// Makes the route avoid a pose's nodes with a smaller retraction than the index, at any cost, unless the
  /// others are blocked.
  void avoidBelow(std::size_t pose, std::size_t retract) {
    least_retract_[pose] = retract;
    noteChange(pose);
  }

  /// The node of each pose. Among routes of equal cost the choice is deterministic. Poses before the first
  /// one that changed since the last call are not searched again.
  std::vector<std::uint32_t> cheapest();

 private:
  enum class State : std::uint8_t { free, losing, blocked };

  /// Nodes of a layer with the cost of the route to each, and its node in the previous layer.
  struct Layer {
    std::vector<double> cost;
    std::vector<std::uint16_t> before;
  };

  /// One of the three values of a change, and the steps between the values of its grid.
  struct Axis {
    Axis(const std::vector<double>& values, double most_change, std::size_t apart,
         const std::function<double(double)>& step_cost);

    struct Step {
      std::size_t from;  // index of a value
      double cost;
    };
    std::size_t stride;                       // from the nodes of a value to those of the next
    std::vector<std::vector<Step>> steps_to;  // per value
  };

  static constexpr std::size_t kPosesPerKept = 16;

  void noteChange(std::size_t pose) { searched_ = std::min(searched_, pose); }
  double nodeCost(std::size_t pose, std::uint32_t node) const;
  void relax(const Axis& axis, Layer& layer, Layer& next) const;
  void relaxBlocked(const std::vector<double>& costs, std::uint32_t to,
                    const std::set<std::uint32_t>& blocked_from, Layer& layer) const;

  const ChangeGrid* grid_;
  std::size_t poses_;
  std::vector<double> costs_;  // per node, if it is free
  std::vector<Axis> axes_;
  std::vector<State> states_;               // per pose and node
  std::vector<std::size_t> least_retract_;  // per pose: smaller ones are avoided
  std::map<std::size_t, std::map<std::uint32_t, std::set<std::uint32_t>>> blocked_steps_;  // pose, to, from
  std::size_t searched_ = 0;                        // the layers of this many poses are known
  std::vector<std::vector<std::uint16_t>> before_;  // per pose: Layer::before
  std::vector<std::vector<double>> kept_costs_;     // Layer::cost of every kPosesPerKept-th pose
};

}  // namespace octoblisk::demos
