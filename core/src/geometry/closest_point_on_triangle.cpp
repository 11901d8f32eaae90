#include "geometry/closest_point_on_triangle.h"

#include <algorithm>
#include <limits>

#include "geometry/thin_triangle.h"

namespace octoblisk {
namespace {

Vec3 closestOnSegment(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double squared = along.squaredNorm();
  if (!(squared > 0.0)) return from;
  const double part = along.dot(point - from) / squared;
  if (part <= 0.0) return from;
  if (part >= 1.0) return to;
  return from + part * along;
}

/// The point closest to `point` among those of the triangle that are level with it along the longest edge.
Vec3 closestAcross(const Triangle& triangle, const Vec3& point) {
  std::size_t longest = 0;
  const auto edge = [&](std::size_t v) -> Vec3 { return triangle[(v + 1) % 3] - triangle[v]; };
  for (std::size_t v = 1; v < 3; ++v) {
    if (edge(v).squaredNorm() > edge(longest).squaredNorm()) longest = v;
  }
  const Vec3 &from = triangle[longest], &to = triangle[(longest + 1) % 3],
             &third = triangle[(longest + 2) % 3];
  const Vec3 along = edge(longest);
  const double squared = along.squaredNorm();
  if (!(squared > 0.0)) return from;
  const auto partOf = [&](const Vec3& x) { return std::clamp(along.dot(x - from) / squared, 0.0, 1.0); };
  const double part = partOf(point), third_part = partOf(third);
  const auto onOtherEdges = [&]() -> Vec3 {
    if (part < third_part) return from + part / third_part * (third - from);
    if (part < 1.0) return to + (1.0 - part) / (1.0 - third_part) * (third - to);
    return to;
  };
  return closestOnSegment(from + part * along, onOtherEdges(), point);
}

}  // namespace

detail::ClosestOnTriangle detail::closestPointOf(const Triangle& triangle, const Vec3& normal,
                                                 const Vec3& point) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, offset = point - a;
  const double squared = normal.squaredNorm();
  const bool is_thin = detail::isThin(squared, detail::squaredLongestEdge(triangle));
  // Twice the areas of the triangles that the foot forms with each edge, times the normal's length.
  const Vec3 turned = offset.cross(normal);
  const double at_ab = ab.dot(turned), at_ca = -ac.dot(turned), at_bc = squared - at_ab - at_ca;
  const bool is_over = squared > 0.0 && at_ab >= 0.0 && at_bc >= 0.0 && at_ca >= 0.0;
  if (is_over && !is_thin) return {point - normal * (normal.dot(offset) / squared), true};
  // Otherwise the closest point is on an edge that separates the foot from the triangle. If the triangle is
  // thin, it may be anywhere: take the nearest of all edges and of a line across, level with the point.
  Vec3 closest = a;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3& candidate) {
    const double distance = (candidate - point).squaredNorm();
    if (!(distance < least)) return;
    least = distance;
    closest = candidate;
  };
  if (is_thin) offer(closestAcross(triangle, point));
  if (is_thin || at_ab < 0.0) offer(closestOnSegment(a, b, point));
  if (is_thin || at_bc < 0.0) offer(closestOnSegment(b, c, point));
  if (is_thin || at_ca < 0.0) offer(closestOnSegment(c, a, point));
  return {closest, false};
}

Vec3 closestPoint(const Triangle& triangle, const Vec3& point) {
  return detail::closestPointOf(triangle, scaledNormal(triangle), point).point;
}

}  // namespace octoblisk
