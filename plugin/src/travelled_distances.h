// How far bodies have moved, in total.
#pragma once

#include <LinearMath/btTransform.h>

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "octoblisk/types.h"

struct btBroadphaseProxy;

namespace octoblisk {
class ClusteredOctree;
}

namespace octoblisk::detail {

/// How far each body has moved since the first call of `of` for it. Two bodies are still apart if they were
/// farther apart than the sum of their distances since then.
class TravelledDistances {
 public:
  /// Call this when bodies may have moved.
  void beginStep() { ++step_; }

  /// Never less than the distance that any point of the body's mesh, or of its box if it has no tree, has
  /// moved, summed over the steps. Another shape, margin or threshold counts as a distance longer than the
  /// body. Infinite for compounds, and where the pose or the box is not a number. The body must have a shape.
  /// Keeps the body's tree alive until the next call for the body.
  double of(const btBroadphaseProxy& proxy);

  /// Call this before the proxy is deleted.
  void forget(const btBroadphaseProxy& proxy) { bodies_.erase(&proxy); }

 private:
  struct State {
    std::shared_ptr<const ClusteredOctree> tree;  // null: the box represents the body
    bool is_solid = false;
    double reach = 0.0;
    Pose in_world;
    Aabb box;  // of proxy and shape, in the world
  };
  struct Body {
    State state;
    double travelled = 0.0;
    std::uint64_t step = 0;
  };

  static State stateOf(const btBroadphaseProxy& proxy);
  static double distance(const State& from, const State& to);

  std::uint64_t step_ = 1;
  std::unordered_map<const btBroadphaseProxy*, Body> bodies_;
};

}  // namespace octoblisk::detail
