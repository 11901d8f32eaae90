// Bullet's ray tests and convex sweeps against ClusteredOctreeShape, from within Bullet's generic code for
// concave shapes.
//
// That code passes the bounds of the whole motion and a callback that tests each triangle. The callback knows
// the motion, so the tree is searched along it and everything beyond the nearest hit is skipped.
#pragma once

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/triangle_parts.h"

class btTriangleCallback;

namespace octoblisk::detail {

/// Passes triangles to a callback as Bullet's meshes do, but only those whose bounds meet a box in the mesh's
/// frame.
class TriangleHandover {
 public:
  TriangleHandover(const ClusteredOctree& tree, const TriangleParts& parts, const Aabb& box)
      : tree_(tree), parts_(parts), box_(box) {}

  const ClusteredOctree& tree() const { return tree_; }
  TriangleId id(std::uint32_t triangle) const { return parts_.id(triangle); }
  void operator()(btTriangleCallback& callback, std::uint32_t triangle) const;

 private:
  const ClusteredOctree& tree_;
  const TriangleParts& parts_;
  const Aabb box_;
};

/// If the callback is a btTriangleRaycastCallback or a btTriangleConvexcastCallback, finds its hits among the
/// triangles along its motion, roughly nearest first, and returns true. Otherwise returns false.
///
/// A ray's callback gets every triangle that it may count as a hit below its m_hitFraction, including its
/// tolerance at edges. Its hits are therefore those of the generic code.
///
/// A sweep's callback gets its hits through reportHit; its processTriangle is not called. They are the exact
/// impacts on each triangle (query/triangle_sweep.h). Bullet's own sweep stops 0.001 units before a triangle,
/// and misses some. Bullet does not change a sweep's m_hitFraction. Here, if reportHit returns exactly the
/// fraction that it was given, as closest-hit callbacks do, farther hits are skipped from then on.
bool castTriangles(btTriangleCallback& callback, const TriangleHandover& hand_over);

}  // namespace octoblisk::detail
