// A frame along a direction.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// A right-handed orthonormal frame whose first column is `direction`, a unit vector.
inline Mat3 frameAlong(const Vec3& direction) {
  Mat3 frame;
  frame.col(0) = direction;
  frame.col(1) = direction.unitOrthogonal();
  frame.col(2) = direction.cross(frame.col(1));
  return frame;
}

}  // namespace octoblisk::detail
