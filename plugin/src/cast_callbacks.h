// Bullet's ray tests and convex sweeps against our shape, from within its generic path for concave shapes.
//
// That path gives a shape the bounds of the whole way and a callback that tests each triangle. The callback
// says what the way is: so the tree is walked along it, and what lies beyond the nearest hit is left out.
#pragma once

#include "octoblisk/clustered_octree.h"
#include "octoblisk_bullet/triangle_parts.h"

class btTriangleCallback;

namespace octoblisk::detail {

/// Gives a callback triangles as Bullet's meshes do, those alone whose bounds meet a box in the mesh's frame.
class TriangleHandover {
 public:
  TriangleHandover(const ClusteredOctree& tree, const TriangleParts& parts, const Aabb& box)
      : tree_(tree), parts_(parts), box_(box) {}

  const ClusteredOctree& tree() const { return tree_; }
  void operator()(btTriangleCallback& callback, std::uint32_t triangle) const;

 private:
  const ClusteredOctree& tree_;
  const TriangleParts& parts_;
  const Aabb box_;
};

/// Where the callback is a btTriangleRaycastCallback or a btTriangleConvexcastCallback, hands over the
/// triangles on its way, nearer ones first by and large, and returns true; else false.
///
/// A ray's callback is given every triangle that it may count as hit at less than its m_hitFraction, its
/// tolerance at edges included: its hits are those of the generic path.
///
/// A sweep's callback is told of its hits by reportHit, and they are those of the generic path, found by
/// Bullet's own btTriangleConvexcastCallback::processTriangle; one that a class derived from it has instead
/// is not called. Bullet leaves a sweep's m_hitFraction as it is; here, where reportHit returns the very
/// fraction it was told, as closest-hit callbacks do, farther hits are left out from then on.
bool castTriangles(btTriangleCallback& callback, const TriangleHandover& hand_over);

}  // namespace octoblisk::detail
