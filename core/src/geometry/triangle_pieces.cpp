#include "geometry/triangle_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "geometry/thin_triangle.h"

namespace octoblisk::detail {
namespace {

/// The points where normal · point = offset.
struct Plane {
  Vec3 normal = Vec3::Zero();
  double offset = 0.0;

  double height(const Vec3& point) const { return normal.dot(point) - offset; }
};

Plane planeOf(const Triangle& triangle) {
  const Vec3 normal = unitNormal(triangle);
  return {normal, normal.dot(triangle[0])};
}

/// The plane through an edge of a triangle, perpendicular to it; inside is above.
Plane edgePlane(const Triangle& triangle, const Vec3& normal, std::size_t edge) {
  const Vec3 inward = normal.cross(triangle[(edge + 1) % 3] - triangle[edge]).normalized();
  return {inward, inward.dot(triangle[edge])};
}

/// The least and the greatest height of points.
std::pair<double, double> heightsOf(const Plane& plane, std::span<const Vec3> points) {
  double low = plane.height(points[0]), high = low;
  for (const Vec3& point : points.subspan(1)) {
    low = std::min(low, plane.height(point));
    high = std::max(high, plane.height(point));
  }
  return {low, high};
}

/// The parts of a convex polygon above (+1) or below (-1) a plane.
TrianglePiece side(const TrianglePiece& piece, const Plane& plane, double sign, double tolerance) {
  TrianglePiece kept;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 &from = piece[i], &to = piece[(i + 1) % piece.size()];
    const double here = sign * plane.height(from), there = sign * plane.height(to);
    if (here >= -tolerance) kept.push_back(from);
    if ((here > tolerance && there < -tolerance) || (here < -tolerance && there > tolerance))
      kept.push_back(from + (to - from) * (here / (here - there)));
  }
  return kept;
}

/// The length of the part of a segment that is inside the edges of a triangle, moved outward by the slack.
double lengthWithin(const Triangle& triangle, const Vec3& normal, const Vec3& from, const Vec3& to,
                    double slack) {
  double begin = 0.0, end = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Plane edge = edgePlane(triangle, normal, i);
    const double first = edge.height(from) + slack, last = edge.height(to) + slack;
    if (first < 0.0 && last < 0.0) return 0.0;
    if (first < 0.0) begin = std::max(begin, first / (first - last));
    if (last < 0.0) end = std::min(end, first / (first - last));
  }
  return (end - begin) * (to - from).norm();
}

/// Whether the length of a part found with the slack is more than that of a part near a corner.
bool isLong(double length, double tolerance) { return length > 1e4 * tolerance; }

/// Whether the plane of a triangle crosses the polygon along the triangle, for more than the tolerance. The
/// triangle may also end there.
bool meetsAlong(std::span<const Vec3> polygon, const Plane& plane, const Triangle& triangle,
                double tolerance) {
  std::array<Vec3, 2> ends;
  std::size_t count = 0;
  for (std::size_t i = 0; i < polygon.size() && count < 2; ++i) {
    const Vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double here = plane.height(from), there = plane.height(to);
    if ((here > 0.0) != (there > 0.0)) ends[count++] = from + (to - from) * (here / (here - there));
  }
  if (count < 2) return false;
  return lengthWithin(triangle, plane.normal, ends[0], ends[1], 0.0) > tolerance ||
         isLong(lengthWithin(triangle, plane.normal, ends[0], ends[1], tolerance), tolerance);
}

/// The tolerance for points in the plane of a triangle, whose rounding grows with their distance.
double flatness(const Triangle& triangle, std::span<const Vec3> points, double tolerance) {
  const double longest = std::sqrt(squaredLongestEdge(triangle));
  double farthest = longest;
  for (const Vec3& point : points) farthest = std::max(farthest, (point - triangle[0]).norm());
  return tolerance * (1.0 + farthest * longest / scaledNormal(triangle).norm());
}

/// How the other triangle divides a polygon: by the returned planes; by none if it does not.
std::span<const Plane> dividers(const Triangle& other, std::span<const Vec3> polygon, double tolerance,
                                std::array<Plane, 3>& room) {
  room[0] = planeOf(other);
  const auto [low, high] = heightsOf(room[0], polygon);
  const double flat = flatness(other, polygon, tolerance);
  if (low > flat || high < -flat) return {};
  if (low < -flat || high > flat) {
    const bool meets = low < -tolerance && high > tolerance && meetsAlong(polygon, room[0], other, tolerance);
    return std::span<const Plane>(room).first(meets ? 1 : 0);
  }
  const Vec3 normal = room[0].normal;
  for (std::size_t i = 0; i < 3; ++i) {
    room[i] = edgePlane(other, normal, i);
    if (heightsOf(room[i], polygon).second <= tolerance) return {};
  }
  TrianglePiece common(polygon.begin(), polygon.end());
  for (const Plane& edge : room) {
    common = side(common, edge, 1.0, tolerance);
    if (common.size() < 3 || heightsOf(edge, common).second <= tolerance) return {};
  }
  return room;
}

}  // namespace

bool cuts(const Triangle& other, const Triangle& triangle, double tolerance) {
  std::array<Plane, 3> room;
  const auto planes = dividers(other, triangle, tolerance, room);
  return std::ranges::any_of(planes, [&](const Plane& plane) {
    const auto [low, high] = heightsOf(plane, triangle);
    return low < -tolerance && high > tolerance;
  });
}

bool liesAlong(const Triangle& triangle, const Vec3& from, const Vec3& to, double tolerance) {
  const std::array<Vec3, 2> ends = {from, to};
  const Plane plane = planeOf(triangle);
  const auto [low, high] = heightsOf(plane, ends);
  const double flat = flatness(triangle, ends, tolerance);
  return low >= -flat && high <= flat &&
         isLong(lengthWithin(triangle, plane.normal, from, to, tolerance), tolerance);
}

void cutAlong(const Triangle& other, std::vector<TrianglePiece>& pieces, double tolerance) {
  const std::vector<TrianglePiece> before = std::exchange(pieces, {});
  for (const TrianglePiece& piece : before) {
    std::array<Plane, 3> room;
    std::vector<TrianglePiece> parts = {piece};
    for (const Plane& plane : dividers(other, piece, tolerance, room)) {
      std::vector<TrianglePiece> divided;
      for (const TrianglePiece& part : parts) {
        const auto [low, high] = heightsOf(plane, part);
        if (!(low < -tolerance && high > tolerance)) {
          divided.push_back(part);
          continue;
        }
        divided.push_back(side(part, plane, 1.0, tolerance));
        divided.push_back(side(part, plane, -1.0, tolerance));
      }
      parts = std::move(divided);
    }
    for (TrianglePiece& part : parts) {
      if (part.size() >= 3) pieces.push_back(std::move(part));
    }
  }
}

}  // namespace octoblisk::detail
