// The bounding box of points in a given frame.
#pragma once

#include <span>
#include <stdexcept>

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// The box of the points in the given frame. Its centre is the middle of the box, not the centroid. Throws
/// std::invalid_argument if there are no points.
inline Obb boundingBox(std::span<const Vec3> points, const Mat3& axes) {
  if (points.empty()) throw std::invalid_argument("the bounding box of no points is undefined");
  Aabb local;
  for (const Vec3& point : points) local.extend(axes.transpose() * point);
  return {axes * local.center(), axes, local.halfExtents()};
}

}  // namespace octoblisk::detail
