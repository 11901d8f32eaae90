// The triangles near a convex body that moves little from one question to the next.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/convex.h"
#include "octoblisk/leaf_vertices.h"

namespace octoblisk {

/// Up to eight triangles with their corners in the frame of a box (leaf_vertices.h).
struct TriangleBundle {
  BoxF box;
  LeafVertices corners;
  std::array<std::uint32_t, kLanes> triangles;
  std::uint32_t count;
};

/// Keeps the triangles that are a little farther away than was asked for, until the body has moved as far:
/// most questions then need no tree. What is handed out may differ by triangles that are not near.
class NearTriangles {
 public:
  /// Every triangle that may be within `reach` of the body, and some that are not, until the next call.
  /// Allocates nothing once it has had the room.
  std::span<const std::uint32_t> find(const ClusteredOctree& tree, const Convex& convex,
                                      const Pose& convex_in_tree, double reach);

  /// To be called where a tree at the same address has other triangles.
  void forget() { kept_reach_ = kNothing; }

 private:
  static constexpr double kNothing = -1.0;

  double wayTo(const Pose& pose, const Pose& from) const;
  void gather(const ClusteredOctree& tree, const Convex& convex, const Pose& convex_in_tree, double reach);

  const ClusteredOctree* tree_ = nullptr;
  std::vector<Vec3> core_;        ///< points whose hull holds the body's core
  Aabb bounds_;                   ///< of them
  double kept_reach_ = kNothing;  ///< from the core
  Pose kept_at_, last_at_;
  std::vector<TriangleBundle> kept_;
  std::vector<std::uint32_t> found_;
};

}  // namespace octoblisk
