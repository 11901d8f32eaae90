// The contact of a triangle and the core of a convex body, which its radius is yet to be added to.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// All in the body's frame.
struct MarginlessContact {
  double distance = 0.0;        ///< where below 0, minus the length of the shortest way that parts the two
  Vec3 normal = Vec3::UnitX();  ///< unit: moving the triangle along it parts the two
  Vec3 on_triangle = Vec3::Zero();
  Vec3 on_core = Vec3::Zero();  ///< on_triangle − distance · normal
};

}  // namespace octoblisk::detail
