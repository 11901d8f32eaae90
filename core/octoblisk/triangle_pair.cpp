#include "octoblisk/triangle_pair.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "octoblisk/predicates.h"
#include "octoblisk/segment_pair.h"

namespace octoblisk {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kThin = 1e-12;  // of its length: the width of a face whose normal is no more than rounding

Vec2 project(const Vec3& point, int dropped_axis) {
  return {point[(dropped_axis + 1) % 3], point[(dropped_axis + 2) % 3]};
}

/// The coordinate axis along which the plane of a, b, c may be projected without flattening it; none where
/// the three points are collinear.
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

/// The foot of `point` on the plane of t, where it lies within t.
std::optional<Vec3> footInside(const Vec3& point, const Triangle& t) {
  const Vec3 normal = scaledNormal(t);
  const double squared = normal.squaredNorm();
  if (!(squared > 0.0)) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    if (normal.cross(t[(i + 1) % 3] - t[i]).dot(point - t[i]) < 0.0) return std::nullopt;
  }
  return point - normal * (normal.dot(point - t[0]) / squared);
}

/// A triangle clipped by the prism over another: at most six corners, were it not for rounding, by which an
/// edge of the polygon may seem to cross a side twice. A side then makes 4 corners of 3, 6 of 4, and 9 of 6.
struct Polygon {
  std::array<Vec3, 9> corner;
  int count = 0;

  void add(const Vec3& point) {
    assert(count < static_cast<int>(corner.size()));
    corner[static_cast<std::size_t>(count++)] = point;
  }
};

Polygon clip(const Polygon& polygon, const Vec3& inward, const Vec3& on_plane) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3 &from = polygon.corner[i], &to = polygon.corner[(i + 1) % polygon.count];
    const double height_from = inward.dot(from - on_plane), height_to = inward.dot(to - on_plane);
    if (height_from >= 0.0) kept.add(from);
    if ((height_from < 0.0) != (height_to < 0.0)) {
      kept.add(from + (to - from) * (height_from / (height_from - height_to)));
    }
  }
  return kept;
}

/// How deep `other` reaches below `face` within the prism over it.
struct Penetration {
  double depth;
  Vec3 deepest;  ///< on other
  Vec3 normal;   ///< unit, outward of face
};

/// None where the face is degenerate, or so thin that its normal is all rounding.
std::optional<Penetration> penetration(const Triangle& face, const Triangle& other) {
  const Vec3 scaled = scaledNormal(face);
  const double longest = std::max({(face[1] - face[0]).squaredNorm(), (face[2] - face[1]).squaredNorm(),
                                   (face[0] - face[2]).squaredNorm()});
  if (!(scaled.norm() > kThin * longest)) return std::nullopt;
  const Vec3 normal = unit(scaled);
  Polygon polygon;
  for (const Vec3& corner : other) polygon.add(corner);
  for (int i = 0; i < 3 && polygon.count > 0; ++i) {
    polygon = clip(polygon, scaled.cross(face[(i + 1) % 3] - face[i]), face[i]);
  }
  // The two meet: where rounding leaves nothing over the face, they do so at its rim.
  if (polygon.count == 0) return Penetration{0.0, closestPoints(face, other).point_on_b, normal};
  const auto depthOf = [&](const Vec3& point) { return -normal.dot(point - face[0]); };
  const std::span<const Vec3> corners(polygon.corner.data(), static_cast<std::size_t>(polygon.count));
  const Vec3 deepest = *std::ranges::max_element(corners, {}, depthOf);
  return Penetration{std::max(0.0, depthOf(deepest)), deepest, normal};
}

}  // namespace

bool intersects(const Triangle& a, const Triangle& b) {
  const std::array<int, 3> side_of_b = sidesOf(a, b);
  if (allOnOneSide(side_of_b)) return false;
  const std::array<int, 3> side_of_a = sidesOf(b, a);
  if (allOnOneSide(side_of_a)) return false;
  // Two triangles that meet do so in a convex set whose ends lie on the edge of one of them.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (segmentMeets(b[i], b[j], side_of_b[i], side_of_b[j], a)) return true;
    if (segmentMeets(a[i], a[j], side_of_a[i], side_of_a[j], b)) return true;
  }
  return false;
}

Contact closestPoints(const Triangle& a, const Triangle& b) {
  PointPair best;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) closestOnSegments(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3], best);
    if (const std::optional<Vec3> foot = footInside(a[i], b)) keepCloser(best, a[i], *foot);
    if (const std::optional<Vec3> foot = footInside(b[i], a)) keepCloser(best, *foot, b[i]);
  }
  const double distance = std::sqrt(best.squared_distance);
  Vec3 normal = best.on_a - best.on_b;
  if (!(distance > 0.0)) normal = scaledNormal(b);
  if (!(normal.squaredNorm() > 0.0)) normal = -scaledNormal(a);
  if (!(normal.squaredNorm() > 0.0)) normal = Vec3::UnitX();
  // Rounding must not make two that do not meet touch.
  return {best.on_a,    best.on_b,
          unit(normal), std::max(distance, std::numeric_limits<double>::denorm_min()),
          kNoTriangle,  kNoTriangle};
}

Contact contactOf(const Triangle& a, const Triangle& b) {
  return intersects(a, b) ? meetingContact(a, b) : closestPoints(a, b);
}

Contact meetingContact(const Triangle& a, const Triangle& b) {
  const std::optional<Penetration> below_a = penetration(a, b), below_b = penetration(b, a);
  if (below_a && (!below_b || below_a->depth <= below_b->depth)) {
    return {below_a->deepest + below_a->depth * below_a->normal,
            below_a->deepest,
            -below_a->normal,
            -below_a->depth,
            kNoTriangle,
            kNoTriangle};
  }
  if (below_b) {
    return {below_b->deepest, below_b->deepest + below_b->depth * below_b->normal,
            below_b->normal,  -below_b->depth,
            kNoTriangle,      kNoTriangle};
  }
  // Two degenerate triangles: where they meet is known to their width.
  Contact touch = closestPoints(a, b);
  touch.point_on_a = touch.point_on_b = 0.5 * (touch.point_on_a + touch.point_on_b);
  touch.distance = -0.0;
  return touch;
}

}  // namespace octoblisk
