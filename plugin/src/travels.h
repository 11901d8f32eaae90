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

/// The distance that each body has travelled since the first question about it. Two bodies that were farther
/// apart than they have travelled since then are still apart.
class Travels {
 public:
  /// Call this when bodies may have moved.
  void beginLook() { ++look_; }

  /// At least the way of any point that clustersMeet (near_bodies.h) uses for the body. Another shape, margin
  /// or threshold counts as a way longer than the body. Infinite for compounds. The body must have a shape.
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
    std::uint64_t look = 0;
  };

  static State stateOf(const btBroadphaseProxy& proxy);
  static double way(const State& from, const State& to);

  std::uint64_t look_ = 1;
  std::unordered_map<const btBroadphaseProxy*, Body> bodies_;
};

}  // namespace octoblisk::detail
