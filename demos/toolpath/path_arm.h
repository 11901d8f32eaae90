// The direction in which the grinder's arm leaves the channel between two blades.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::demos {

/// Outward, away from the axis; or, if a shroud closes the channels there, through one of their ends:
/// upstream towards smaller z, downstream towards greater z.
enum class PathArm { outward, upstream, downstream };

/// The unit direction of the arm in the tangent plane of a surface (its normal of unit length) at a point.
/// The blisk's axis is Z.
inline Vec3 armInSurface(PathArm arm, const Vec3& point, const Vec3& normal) {
  const Vec3 away = arm == PathArm::outward    ? Vec3(point.x(), point.y(), 0.0)
                    : arm == PathArm::upstream ? Vec3(-Vec3::UnitZ())
                                               : Vec3(Vec3::UnitZ());
  return (away - away.dot(normal) * normal).normalized();
}

}  // namespace octoblisk::demos
