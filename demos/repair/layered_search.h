// The cheapest way through layers of nodes, one layer a pose, where little may change from layer to layer.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "repair/change_grid.h"

namespace octoblisk::demos {

/// Dynamic programming over the poses of a path. Every node counts as free until it is said to be blocked. A
/// blocked node or step may still be gone where nothing else leads on, for more than all free ones together:
/// so the way has as few of them as can be. Of such ways it has as few nodes that lose contact as can be, and
/// the least cost among those.
class LayeredSearch {
 public:
  /// The grid must outlive it. Of so many poses, at least one.
  LayeredSearch(const ChangeGrid& grid, std::size_t poses);

  void blockNode(std::size_t pose, std::uint32_t node) {
    states_[pose * grid_->size() + node] = State::blocked;
  }

  /// Says that the tool loses its contact there.
  void markLosing(std::size_t pose, std::uint32_t node) {
    State& state = states_[pose * grid_->size() + node];
    state = std::max(state, State::losing);
  }

  /// The step from a node to another of the next pose, which is `pose`.
  void blockStep(std::size_t pose, std::uint32_t from, std::uint32_t to) {
    blocked_steps_[pose][to].insert(from);
  }

  /// Takes back what was said of the steps to a pose.
  void unblockSteps(std::size_t pose) { blocked_steps_.erase(pose); }

  /// Has the way keep off a pose's nodes of a lesser retraction than that of the index, whatever it costs,
  /// unless others are blocked.
  void avoidBelow(std::size_t pose, std::size_t retract) { least_retract_[pose] = retract; }

  /// The node of each pose. Of ways of equal cost always the same.
  std::vector<std::uint32_t> cheapest() const;

 private:
  enum class State : std::uint8_t { free, losing, blocked };

  /// Nodes of a layer with the cost of the way to each, and its node in the layer before.
  struct Layer {
    std::vector<double> cost;
    std::vector<std::uint16_t> before;
  };

  /// One of the three values of a change, and the steps between its grid's values.
  struct Axis {
    Axis(const std::vector<double>& values, double most_change, std::size_t apart,
         const std::function<double(double)>& step_cost);

    struct Step {
      std::size_t from;  // number of a value
      double cost;
    };
    std::size_t stride;                       // from a value's nodes to the next value's
    std::vector<std::vector<Step>> steps_to;  // each value
  };

  double nodeCost(std::size_t pose, std::uint32_t node) const;
  void relax(const Axis& axis, Layer& layer, Layer& next) const;
  void relaxBlocked(const std::vector<double>& costs, std::uint32_t to,
                    const std::set<std::uint32_t>& blocked_from, Layer& layer) const;

  const ChangeGrid* grid_;
  std::size_t poses_;
  std::vector<double> costs_;  // of each node, were it free
  std::vector<Axis> axes_;
  std::vector<State> states_;               // of each pose and node
  std::vector<std::size_t> least_retract_;  // of each pose: lesser ones are avoided
  std::map<std::size_t, std::map<std::uint32_t, std::set<std::uint32_t>>> blocked_steps_;  // pose, to, from
};

}  // namespace octoblisk::demos
