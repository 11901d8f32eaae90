// The bounds of a triangle.
#pragma once

#include "octoblisk/triangle_mesh.h"

namespace octoblisk {

inline Aabb boundsOf(const Triangle& triangle) {
  Aabb bounds;
  for (const Vec3& corner : triangle) bounds.extend(corner);
  return bounds;
}

}  // namespace octoblisk
