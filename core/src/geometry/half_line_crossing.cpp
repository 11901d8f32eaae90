#include "geometry/half_line_crossing.h"

#include <utility>

#include "geometry/predicates.h"
#include "geometry/triangle_pair.h"

namespace octoblisk::detail {
namespace {

using Vec2 = Eigen::Vector2d;

Vec2 alongX(const Vec3& point) { return point.tail<2>(); }

/// Whether the moved line through the point meets the triangle. In the yz plane: whether the half-line from
/// the moved point along +z crosses the triangle's outline an odd number of times.
bool lineCrosses(const Vec3& point, const Triangle& triangle) {
  bool odd = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 *low = &triangle[i], *high = &triangle[(i + 1) % 3];
    const bool low_is_beyond = low->y() > point.y(), high_is_beyond = high->y() > point.y();
    if (low_is_beyond == high_is_beyond) continue;
    if (low_is_beyond) std::swap(low, high);
    // A point left of the edge, or on it and therefore moved to its left, is above it.
    odd ^= orient2d(alongX(*low), alongX(*high), alongX(point)) < 0;
  }
  return odd;
}

/// Whether the bounds show that the half-line does not meet the triangle.
bool isPast(const Vec3& point, const Aabb& bounds) {
  return bounds.max.x() < point.x() || point.y() < bounds.min.y() || bounds.max.y() < point.y() ||
         point.z() < bounds.min.z() || bounds.max.z() < point.z();
}

/// +1 or -1 if the moved half-line leaves or enters through the triangle, which is not past; otherwise 0.
int crossing(const Vec3& point, const Triangle& triangle, const Aabb& bounds) {
  if (!lineCrosses(point, triangle)) return 0;
  const int toward_x = orient2d(alongX(triangle[0]), alongX(triangle[1]), alongX(triangle[2]));
  if (bounds.min.x() > point.x()) return toward_x;
  // The line meets the plane ahead of the point if the point is on the opposite side of +x.
  const int side = orient3d(triangle[0], triangle[1], triangle[2], point);
  return side * toward_x < 0 ? toward_x : 0;
}

}  // namespace

Crossing halfLineCrossing(const Vec3& point, const Triangle& triangle) {
  const Aabb bounds = boundsOf(triangle);
  if (isPast(point, bounds)) return Crossing::none;
  if (bounds.min.x() <= point.x() && intersects(triangle, {point, point, point}))
    return Crossing::on_triangle;
  const int sign = crossing(point, triangle, bounds);
  return sign == 0 ? Crossing::none : sign > 0 ? Crossing::leaving : Crossing::entering;
}

int signedCrossing(const Vec3& point, const Triangle& triangle) {
  const Aabb bounds = boundsOf(triangle);
  return isPast(point, bounds) ? 0 : crossing(point, triangle, bounds);
}

int sideInPlane(const Vec3& normal) {
  // The half-line does not meet the plane ahead, and moves along +z and +y.
  for (const double component : {normal.x(), normal.z(), normal.y()}) {
    if (component != 0.0) return component > 0.0 ? 1 : -1;
  }
  return 1;
}

}  // namespace octoblisk::detail
