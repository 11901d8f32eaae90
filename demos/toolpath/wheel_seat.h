// Where a contact wheel comes to lie on a blade.
#pragma once

#include <memory>
#include <span>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// A wheel with its belt, taken for a cylinder about the tool's z through its origin, over the triangles of a
/// blade. Lengths in mm.
class WheelSeat {
 public:
  /// Throws std::invalid_argument where the blade has no triangles, or the wheel no size.
  WheelSeat(const TriangleMesh& blisk, std::span<const int> blade_of_triangle, int blade, double radius,
            double width);

  /// The pose shifted along `normal` (of unit length, off the surface): the wheel comes down along it from
  /// outside until it touches the blade, to 1 µm, and goes on for `depth`. So no point of the one is deeper
  /// in the other. Where it is in the blade at 16 mm already, the pose is left as it is.
  Pose seated(const Pose& tool_in_blisk, const Vec3& normal, double depth) const;

 private:
  std::shared_ptr<const ClusteredOctree> blade_, wheel_;
};

}  // namespace octoblisk::demos
