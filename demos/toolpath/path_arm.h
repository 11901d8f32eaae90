// The direction in which the grinder's arm leaves the channel between two blades, and the belt's pose.
#pragma once

#include <cmath>

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

/// The pose belt_in_blisk (belt_grinder.h) at a point of a surface with that normal. The arm leads along
/// `in_surface`, a unit direction in the tangent plane, and leans away from the surface by an angle
/// (radians). The contact wheel's centre is `height` above the point.
inline Pose beltAt(const Vec3& point, const Vec3& normal, const Vec3& in_surface, double lean,
                   double height) {
  const Vec3 arm = std::cos(lean) * in_surface + std::sin(lean) * normal;
  const Vec3 wheel_axis = in_surface.cross(normal);
  Pose belt_in_blisk;
  belt_in_blisk.rotation << arm, wheel_axis.cross(arm), wheel_axis;
  belt_in_blisk.translation = point + height * normal;
  return belt_in_blisk;
}

}  // namespace octoblisk::demos
