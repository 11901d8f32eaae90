#include "body_parts.h"

namespace octoblisk::detail {

Pose orthonormalPose(const btTransform& transform) {
  const Pose pose = fromBullet(transform);
  return {Eigen::Quaterniond(pose.rotation).normalized().toRotationMatrix(), pose.translation};
}

ConvexCore& convexCoreOfThread() {
  thread_local ConvexCore corners;
  return corners;
}

}  // namespace octoblisk::detail
