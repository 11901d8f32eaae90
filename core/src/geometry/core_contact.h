// The contact between a triangle and the core of a convex body, before the body's radius is applied.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// All values are in the frame of the body.
struct CoreContact {
  double distance = 0.0;        ///< if negative, minus the length of the shortest separating translation
  Vec3 normal = Vec3::UnitX();  ///< unit: moving the triangle along it separates the two
  Vec3 on_triangle = Vec3::Zero();
  Vec3 on_core = Vec3::Zero();  ///< on_triangle − distance · normal
};

}  // namespace octoblisk::detail
