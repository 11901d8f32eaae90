// Which way a belt runs at each of its points.
#pragma once

#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

/// The loop of a belt round its wheels, which turn about the tool's z: the convex hull of the belt's vertices
/// seen along z, as a belt under tension is convex.
class BeltLoop {
 public:
  explicit BeltLoop(const TriangleMesh& belt);

  /// The unit direction, in the tool's frame, in which the belt runs at the point of the loop nearest to one:
  /// from the contact side at -x over +y to the drive wheel. Zero where the belt has no extent.
  Vec3 directionAt(const Vec3& point) const;

 private:
  std::vector<Eigen::Vector2d> corners_;  // in the order that the belt runs
};

}  // namespace octoblisk::demos
