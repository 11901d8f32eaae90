#include "geometry/triangle_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "geometry/closest_point_on_triangle.h"
#include "geometry/polygon.h"
#include "geometry/predicates.h"
#include "geometry/segment_pair.h"
#include "geometry/thin_triangle.h"

namespace octoblisk::detail {
namespace {

using Vec2 = Eigen::Vector2d;

Vec2 project(const Vec3& point, int dropped_axis) {
  return {point[(dropped_axis + 1) % 3], point[(dropped_axis + 2) % 3]};
}

/// The coordinate axis along which the plane of a, b, c can be projected without flattening it; none if the
/// three points are collinear.
std::optional<int> droppableAxis(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orient2d(project(a, axis), project(b, axis), project(c, axis)) != 0) return axis;
  }
  return std::nullopt;
}

bool intervalsOverlap(double a0, double a1, double b0, double b1) {
  return std::max(std::min(a0, a1), std::min(b0, b1)) <= std::min(std::max(a0, a1), std::max(b0, b1));
}

bool segmentsMeet2d(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1) {
  if (!intervalsOverlap(a0.x(), a1.x(), b0.x(), b1.x()) ||
      !intervalsOverlap(a0.y(), a1.y(), b0.y(), b1.y())) {
    return false;
  }
  return orient2d(a0, a1, b0) * orient2d(a0, a1, b1) <= 0 && orient2d(b0, b1, a0) * orient2d(b0, b1, a1) <= 0;
}

bool segmentsMeet(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
  if (orient3d(a0, a1, b0, b1) != 0) return false;
  std::optional<int> axis = droppableAxis(a0, a1, b0);
  if (!axis) axis = droppableAxis(a0, a1, b1);
  if (!axis) axis = droppableAxis(b0, b1, a0);
  if (!axis) axis = droppableAxis(b0, b1, a1);
  if (!axis) {  // all four points on one line
    for (int k = 0; k < 3; ++k) {
      if (!intervalsOverlap(a0[k], a1[k], b0[k], b1[k])) return false;
    }
    return true;
  }
  return segmentsMeet2d(project(a0, *axis), project(a1, *axis), project(b0, *axis), project(b1, *axis));
}

bool coplanarSegmentMeets(const Vec3& p, const Vec3& q, const Triangle& t, int dropped_axis) {
  const Vec2 p2 = project(p, dropped_axis), q2 = project(q, dropped_axis);
  const std::array<Vec2, 3> corner = {project(t[0], dropped_axis), project(t[1], dropped_axis),
                                      project(t[2], dropped_axis)};
  const int turn = orient2d(corner[0], corner[1], corner[2]);
  bool p_inside = true;
  for (int i = 0; i < 3; ++i) {
    const Vec2 &from = corner[i], &to = corner[(i + 1) % 3];
    p_inside &= turn * orient2d(from, to, p2) >= 0;
    if (segmentsMeet2d(p2, q2, from, to)) return true;
  }
  return p_inside;
}

/// Whether the closed segment pq, whose ends lie on the given sides of t's plane, meets the closed triangle
/// t.
bool segmentMeets(const Vec3& p, const Vec3& q, int side_p, int side_q, const Triangle& t) {
  if (side_p * side_q > 0) return false;
  if (side_p != 0 || side_q != 0) {
    const int s0 = orient3d(p, q, t[0], t[1]), s1 = orient3d(p, q, t[1], t[2]),
              s2 = orient3d(p, q, t[2], t[0]);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
  }
  if (const std::optional<int> axis = droppableAxis(t[0], t[1], t[2]))
    return coplanarSegmentMeets(p, q, t, *axis);
  return segmentsMeet(p, q, t[0], t[1]) || segmentsMeet(p, q, t[1], t[2]) || segmentsMeet(p, q, t[2], t[0]);
}

/// The sides of t's plane that the corners of `other` lie on.
std::array<int, 3> sidesOf(const Triangle& t, const Triangle& other) {
  return {orient3d(t[0], t[1], t[2], other[0]), orient3d(t[0], t[1], t[2], other[1]),
          orient3d(t[0], t[1], t[2], other[2])};
}

bool allOnOneSide(const std::array<int, 3>& side) {
  return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
}

/// Unit length to the last bit, however small the vector's components.
Vec3 unit(const Vec3& vector) { return vector.stableNormalized().normalized(); }

/// A triangle with the data that heights over it need.
struct Face {
  const Triangle& corner;
  Vec3 normal;  ///< outward, as long as twice the triangle's area
  double squared_normal;
  double squared_longest;      ///< edge
  std::array<Vec3, 3> inward;  ///< from each edge, in the triangle's plane

  explicit Face(const Triangle& t)
      : corner(t),
        normal(scaledNormal(t)),
        squared_normal(normal.squaredNorm()),
        squared_longest(squaredLongestEdge(t)) {
    for (std::size_t i = 0; i < 3; ++i) inward[i] = normal.cross(t[(i + 1) % 3] - t[i]);
  }

  /// Whether twice the area is above a fraction of the square of the longest edge.
  bool isWiderThan(double fraction) const {
    return squared_normal > fraction * fraction * squared_longest * squared_longest;
  }
  /// If so, a foot on the plane may be beside the triangle.
  bool isThin() const { return detail::isThin(squared_normal, squared_longest); }

  /// The height over the plane, times the normal's length.
  double height(const Vec3& point) const { return normal.dot(point - corner[0]); }
  /// Whether a point is in the prism over the triangle.
  bool isOver(const Vec3& point) const {
    return inward[0].dot(point - corner[0]) >= 0.0 && inward[1].dot(point - corner[1]) >= 0.0 &&
           inward[2].dot(point - corner[2]) >= 0.0;
  }
  Vec3 foot(const Vec3& point) const { return point - normal * (height(point) / squared_normal); }
};

/// Whether a plane through an edge of the face, perpendicular to the face, surely separates it from a
/// triangle that is nearly in its plane.
bool isBeside(const Face& face, const Triangle& other) {
  constexpr double kInPlane = 1e-9, kRounding = 1e-14;  // relative to the size
  double size = 0.0;
  for (const Triangle* triangle : {&face.corner, &other}) {
    for (const Vec3& corner : *triangle) size = std::max(size, (corner - face.corner[0]).lpNorm<1>());
  }
  const double near = kInPlane * size * std::sqrt(face.squared_normal);
  const auto isOff = [&](const Vec3& corner) { return std::abs(face.height(corner)) > near; };
  if (std::ranges::any_of(other, isOff)) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& inward = face.inward[i];
    const auto along = [&](const Vec3& corner) { return inward.dot(corner - face.corner[i]); };
    const double highest = std::max({along(other[0]), along(other[1]), along(other[2])});
    const double own = std::min({along(face.corner[0]), along(face.corner[1]), along(face.corner[2])});
    const double rounding = kRounding * size * inward.lpNorm<1>() + std::numeric_limits<double>::min();
    if (highest + rounding < own) return true;
  }
  return false;
}

/// The corner of `other` that is nearest to the face, if this is obvious: no corner is on the other side, the
/// nearest is over the face, and the face is not thin.
std::optional<Vec3> nearestOver(const Face& face, const Triangle& other) {
  constexpr double kWide = 1e-2;  // the normal is accurate to a few units in the last place
  if (!face.isWiderThan(kWide)) return std::nullopt;
  const std::array<double, 3> height = {face.height(other[0]), face.height(other[1]), face.height(other[2])};
  const auto [least, most] = std::ranges::minmax_element(height);
  if (!(*least > 0.0) && !(*most < 0.0)) return std::nullopt;
  const Vec3& nearest = other[static_cast<std::size_t>((*least > 0.0 ? least : most) - height.begin())];
  return face.isOver(nearest) ? std::optional(nearest) : std::nullopt;
}

/// The point of a face that is closest to a point over it; for a thin face, to any point.
std::optional<Vec3> inside(const Face& face, const Vec3& point) {
  if (face.isThin()) return closestPointOf(face.corner, face.normal, point).point;
  return face.isOver(point) ? std::optional(face.foot(point)) : std::nullopt;
}

/// Whether two planes perpendicular to the line between two points separate the triangles, up to rounding of
/// the distance. Then nothing is nearer.
bool isLeast(const PointPair& found, const Triangle& a, const Triangle& b, double size) {
  constexpr double kRounding = 1e-14;  // relative to the size
  const Vec3 way = found.on_b - found.on_a;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& corner : b) low = std::min(low, way.dot(corner - found.on_a));
  for (const Vec3& corner : a) high = std::max(high, way.dot(corner - found.on_a));
  return found.squared_distance - (low - high) <= kRounding * size * std::sqrt(found.squared_distance);
}

/// The closest points of two triangles that do not meet, near the origin.
PointPair closestPairAtOrigin(const Triangle& a, const Triangle& b) {
  PointPair best;
  const Face face_a(a), face_b(b);
  if (const std::optional<Vec3> corner = nearestOver(face_a, b)) {
    keepCloser(best, face_a.foot(*corner), *corner);
    return best;
  }
  if (const std::optional<Vec3> corner = nearestOver(face_b, a)) {
    keepCloser(best, *corner, face_b.foot(*corner));
    return best;
  }
  const double size = std::sqrt(std::max(face_a.squared_longest, face_b.squared_longest));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double before = best.squared_distance;
      closestOnSegments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], best);
      if (best.squared_distance < before && isLeast(best, a, b, size)) return best;
    }
    if (const std::optional<Vec3> on_b = inside(face_b, a[i])) keepCloser(best, a[i], *on_b);
    if (const std::optional<Vec3> on_a = inside(face_a, b[i])) keepCloser(best, *on_a, b[i]);
  }
  return best;
}

/// The closest points of two triangles that do not meet. They are found near the origin, so that the distance
/// is accurate relative to the triangles' size, however far away the triangles are.
PointPair closestPair(const Triangle& a, const Triangle& b) {
  const Vec3& origin = a[0];
  PointPair found = closestPairAtOrigin({Vec3::Zero(), a[1] - origin, a[2] - origin},
                                        {b[0] - origin, b[1] - origin, b[2] - origin});
  found.on_a += origin;
  found.on_b += origin;
  return found;
}

/// How deep a triangle reaches below `face` within the prism over it.
struct Penetration {
  double depth;
  Vec3 deepest;  ///< on the triangle
};

/// None if the face is degenerate, or so thin that its normal is only rounding.
std::optional<Penetration> penetration(const Face& face, const Triangle& other) {
  if (!face.isWiderThan(1e-12)) return std::nullopt;
  const auto heightOf = [&](const Vec3& point) { return face.height(point); };
  const auto below = [&](const Vec3& deepest) {
    return Penetration{std::max(0.0, -heightOf(deepest) / std::sqrt(face.squared_normal)), deepest};
  };
  const Vec3& lowest = *std::ranges::min_element(other, {}, heightOf);
  if (face.isOver(lowest)) return below(lowest);
  Polygon<9> over_face(other);  // three cuts turn 3 corners into 4, 6 and 9 at most
  for (std::size_t i = 0; i < 3; ++i) {
    over_face.cut([&](const Vec3& point) { return face.inward[i].dot(point - face.corner[i]); });
  }
  // The two meet. If rounding leaves nothing over the face, they meet at its rim.
  const std::span<const Vec3> corners = over_face.corners();
  if (corners.empty()) return Penetration{0.0, closestPair(face.corner, other).on_b};
  return below(*std::ranges::min_element(corners, {}, heightOf));
}

}  // namespace

bool intersects(const Triangle& a, const Triangle& b) {
  // In one plane, all orientations would need exact arithmetic.
  if (isBeside(Face(a), b) || isBeside(Face(b), a)) return false;
  const std::array<int, 3> side_of_b = sidesOf(a, b);
  if (allOnOneSide(side_of_b)) return false;
  const std::array<int, 3> side_of_a = sidesOf(b, a);
  if (allOnOneSide(side_of_a)) return false;
  // If two triangles meet, they share a convex set whose ends lie on an edge of one of them.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (segmentMeets(b[i], b[j], side_of_b[i], side_of_b[j], a)) return true;
    if (segmentMeets(a[i], a[j], side_of_a[i], side_of_a[j], b)) return true;
  }
  return false;
}

Contact closestPoints(const Triangle& a, const Triangle& b) {
  const PointPair best = closestPair(a, b);
  const double distance = std::sqrt(best.squared_distance);
  Vec3 normal = best.on_a - best.on_b;
  if (!(distance > 0.0)) normal = scaledNormal(b);
  if (!(normal.squaredNorm() > 0.0)) normal = -scaledNormal(a);
  if (!(normal.squaredNorm() > 0.0)) normal = Vec3::UnitX();
  // Rounding must not make triangles touch that do not meet.
  return {best.on_a, best.on_b, unit(normal), std::max(distance, std::numeric_limits<double>::denorm_min())};
}

Contact contactOf(const Triangle& a, const Triangle& b) {
  return intersects(a, b) ? meetingContact(a, b) : closestPoints(a, b);
}

Contact meetingContact(const Triangle& a, const Triangle& b) {
  const Face face_a(a), face_b(b);
  const std::optional<Penetration> below_a = penetration(face_a, b), below_b = penetration(face_b, a);
  if (below_a && (!below_b || below_a->depth <= below_b->depth)) {
    const Vec3 outward = unit(face_a.normal);
    return {below_a->deepest + below_a->depth * outward, below_a->deepest, -outward, -below_a->depth};
  }
  if (below_b) {
    const Vec3 outward = unit(face_b.normal);
    return {below_b->deepest, below_b->deepest + below_b->depth * outward, outward, -below_b->depth};
  }
  // Both triangles are degenerate: the point where they meet is accurate to their width.
  Contact touch = closestPoints(a, b);
  touch.point_on_a = touch.point_on_b = 0.5 * (touch.point_on_a + touch.point_on_b);
  touch.distance = -0.0;
  return touch;
}

}  // namespace octoblisk::detail
