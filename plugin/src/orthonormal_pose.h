// Transforms of Bullet in double precision.
#pragma once

#include "octoblisk_bullet/convert.h"

namespace octoblisk::detail {

/// The transform as a pose that is orthonormal in double precision.
inline Pose orthonormalPose(const btTransform& transform) {
  const Pose pose = fromBullet(transform);
  return {Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix(), pose.translation};
}

}  // namespace octoblisk::detail
