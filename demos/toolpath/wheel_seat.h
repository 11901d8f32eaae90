// Seats a contact wheel on a blade.
#pragma once

#include <memory>
#include <span>

#include "octoblisk/clustered_octree.h"

namespace octoblisk::demos {

/// A wheel with its belt, treated as a cylinder about the tool's z through its origin, on the triangles of a
/// blade. Lengths in mm.
class WheelSeat {
 public:
  /// Throws std::invalid_argument if the blade has no triangles, or the wheel no size.
  WheelSeat(const TriangleMesh& blisk, std::span<const int> blade_of_triangle, int blade, double radius,
            double width);

  /// The pose shifted along `normal` (of unit length, off the surface): the wheel moves in from outside along
  /// it until it touches the blade, to within 1 µm, and then farther by `depth`. So no point of either is
  /// deeper in the other. If the wheel is in the blade 16 mm off already, the pose is returned as it is.
  Pose seated(const Pose& tool_in_blisk, const Vec3& normal, double depth) const;

 private:
  std::shared_ptr<const ClusteredOctree> blade_, wheel_;
};

}  // namespace octoblisk::demos
