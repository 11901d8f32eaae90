// Conversions between Bullet's types and the core's.
#pragma once

#include <LinearMath/btTransform.h>

#include "octoblisk/types.h"

namespace octoblisk {

inline Vec3 fromBullet(const btVector3& v) { return {double(v.x()), double(v.y()), double(v.z())}; }

inline Mat3 fromBullet(const btMatrix3x3& m) {
  Mat3 rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = fromBullet(m[row]).transpose();
  return rotation;
}

inline Pose fromBullet(const btTransform& t) { return {fromBullet(t.getBasis()), fromBullet(t.getOrigin())}; }

inline btVector3 toBullet(const Vec3& v) { return {btScalar(v.x()), btScalar(v.y()), btScalar(v.z())}; }

inline btTransform toBullet(const Pose& pose) {
  const Mat3& r = pose.rotation;
  return btTransform(btMatrix3x3(btScalar(r(0, 0)), btScalar(r(0, 1)), btScalar(r(0, 2)),  //
                                 btScalar(r(1, 0)), btScalar(r(1, 1)), btScalar(r(1, 2)),  //
                                 btScalar(r(2, 0)), btScalar(r(2, 1)), btScalar(r(2, 2))),
                     toBullet(pose.translation));
}

}  // namespace octoblisk
