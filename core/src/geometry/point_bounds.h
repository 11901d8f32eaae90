// The box round some points.
#pragma once

#include <span>

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// Along the points' axes; a triangle is its corners.
inline Aabb boundsOf(std::span<const Vec3> points) {
  Aabb bounds;
  for (const Vec3& point : points) bounds.extend(point);
  return bounds;
}

}  // namespace octoblisk::detail
