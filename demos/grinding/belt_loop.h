// The direction in which a belt runs at each of its points.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The loop of a belt around its wheels, whose axes are along the tool's z: the convex hull of the belt's
/// vertices seen along z, because a belt under tension is convex.
class BeltLoop {
 public:
  explicit BeltLoop(const TriangleMesh& belt);

  /// The unit direction, in the tool's frame, in which the belt runs at the loop's nearest point to `point`:
  /// from the contact side at -x over +y to the drive wheel. Zero if the belt has no extent.
  Vec3 directionAt(const Vec3& point) const;

 private:
  std::vector<Eigen::Vector2d> corners_;  // in the direction of running
};

}  // namespace octoblisk::demos
