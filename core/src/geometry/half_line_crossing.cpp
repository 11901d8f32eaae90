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

}  // namespace

Crossing halfLineCrossing(const Vec3& point, const Triangle& triangle) {
  const auto [low, high] = boundsOf(triangle);
  if (high.x() < point.x() || point.y() < low.y() || high.y() < point.y() || point.z() < low.z() ||
      high.z() < point.z()) {
    return Crossing::none;
  }
  if (low.x() <= point.x() && intersects(triangle, {point, point, point})) return Crossing::on_triangle;
  if (!lineCrosses(point, triangle)) return Crossing::none;
  if (low.x() > point.x()) return Crossing::crossed;
  // The line meets the plane ahead of the point if the point is on the opposite side of +x.
  const int toward_x = orient2d(alongX(triangle[0]), alongX(triangle[1]), alongX(triangle[2]));
  const int side = orient3d(triangle[0], triangle[1], triangle[2], point);
  return side * toward_x < 0 ? Crossing::crossed : Crossing::none;
}

}  // namespace octoblisk::detail
