// The triangles that a moving box may meet, roughly in the order in which it meets them.
#pragma once

#include <cstdint>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/function_ref.h"

namespace octoblisk::detail {

/// A box that moves without turning. At the fraction t, 0 <= t <= 1, it is `start` moved by t · motion. A box
/// without extent is a point that moves along a segment. Lengths are in mesh units, in the mesh's frame.
struct MovingBox {
  Obb start;
  Vec3 motion = Vec3::Zero();
  /// A triangle also counts as near within this fraction of its size (the half diagonal of its bounds), for
  /// callers whose own triangle test includes a rim around the triangle.
  double rim = 0.0;
};

/// A moving point in a cube of half extents `tolerance`. One axis is along the motion, so that the box of the
/// whole motion is narrow.
MovingBox movingPoint(const Vec3& start, const Vec3& motion, double tolerance);

/// Receives a triangle and a fraction before which the box does not meet it. Returns the greatest fraction
/// that is still of interest, or a negative number to stop.
using AlongVisitor = FunctionRef<double(std::uint32_t triangle, double first_fraction)>;

/// Calls visit(triangle, first_fraction) for every triangle that the moving box may meet, and for few others,
/// as long as its fraction is of interest. Triangles in boxes that are met earlier come first, roughly.
/// Allocates nothing. Visits nothing if a number is not finite.
void forEachTriangleAlong(const ClusteredOctree& tree, const MovingBox& box, double last_fraction,
                          AlongVisitor visit);

}  // namespace octoblisk::detail
