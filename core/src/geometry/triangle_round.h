// Contacts of a triangle with the core of a sphere (a point) or of a capsule (a segment) in closed form.
#pragma once

#include <algorithm>
#include <optional>

#include "geometry/core_contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Whether the triangle's normal, scaledNormal(triangle), is mostly rounding.
inline bool isThin(const Triangle& triangle, const Vec3& normal) {
  constexpr double kThinnest = 1e-6;  // relative to its length
  const double longest =
      std::max({(triangle[1] - triangle[0]).squaredNorm(), (triangle[2] - triangle[1]).squaredNorm(),
                (triangle[0] - triangle[2]).squaredNorm()});
  return !(normal.squaredNorm() > kThinnest * kThinnest * longest * longest);
}

/// If the foot of the point is inside the triangle, the normal is the triangle's own, whichever side the
/// point is on. For a point in the triangle, it points away from the side that the triangle faces. None if
/// they are farther apart than `limit`.
std::optional<CoreContact> contactOfPoint(const Triangle& triangle, const Vec3& point, double limit);

/// A segment that goes through the triangle is separated from it along the triangle's normal or across one of
/// its edges, whichever is shorter. The triangle must not be thin.
CoreContact contactOfSegment(const Triangle& triangle, const Vec3& from, const Vec3& to);

}  // namespace octoblisk::detail
