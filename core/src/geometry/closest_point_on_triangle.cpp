#include <algorithm>
#include <limits>

#include "octoblisk/triangle_mesh.h"

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

}  // namespace

Vec3 closestPoint(const Triangle& triangle, const Vec3& point) {
  const auto& [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, offset = point - a;
  const Vec3 normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  constexpr double kFlat = 1e-24;  // of sin²; below this, the normal is mostly rounding
  const bool flat = !(squared > kFlat * longest * longest);
  // Twice the areas of the triangles that the foot forms with each edge, times the normal's length.
  const Vec3 turned = offset.cross(normal);
  const double at_ab = ab.dot(turned), at_ca = -ac.dot(turned), at_bc = squared - at_ab - at_ca;
  if (!flat && at_ab >= 0.0 && at_bc >= 0.0 && at_ca >= 0.0) {
    return point - normal * (normal.dot(offset) / squared);
  }
  // Otherwise the closest point is on an edge that separates the foot from the triangle.
  Vec3 closest = a;
  double least = std::numeric_limits<double>::infinity();
  const auto tryEdge = [&](const Vec3& from, const Vec3& to) {
    const Vec3 candidate = closestOnSegment(from, to, point);
    const double distance = (candidate - point).squaredNorm();
    if (distance < least) {
      least = distance;
      closest = candidate;
    }
  };
  if (flat || at_ab < 0.0) tryEdge(a, b);
  if (flat || at_bc < 0.0) tryEdge(b, c);
  if (flat || at_ca < 0.0) tryEdge(c, a);
  return closest;
}

}  // namespace octoblisk
