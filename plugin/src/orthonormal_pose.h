// Transforms of Bullet in double precision.
#pragma once

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

/// A pose that is nearly orthonormal, made so in double precision.
inline Pose orthonormal(const Pose& pose) {
  return {Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix(), pose.translation};
}

inline Pose orthonormalPose(const btTransform& transform) { return orthonormal(fromBullet(transform)); }

}  // namespace octoblisk::detail
