#include "geometry/triangle_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
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

bool divides(std::span<const Plane> planes, std::span<const Vec3> polygon, double tolerance) {
  return std::ranges::any_of(planes, [&](const Plane& plane) {
    const auto [low, high] = heightsOf(plane, polygon);
    return low < -tolerance && high > tolerance;
  });
}

/// The parts of a polygon between the planes.
std::vector<TrianglePiece> dividedBy(std::span<const Plane> planes, const TrianglePiece& polygon,
                                     double tolerance) {
  std::vector<TrianglePiece> parts = {polygon};
  for (const Plane& plane : planes) {
    std::vector<TrianglePiece> divided;
    for (TrianglePiece& part : parts) {
      if (divides(std::span(&plane, 1), part, tolerance)) {
        divided.push_back(side(part, plane, 1.0, tolerance));
        divided.push_back(side(part, plane, -1.0, tolerance));
      } else {
        divided.push_back(std::move(part));
      }
    }
    parts = std::move(divided);
  }
  std::erase_if(parts, [](const TrianglePiece& part) { return part.size() < 3; });
  return parts;
}

}  // namespace

bool cuts(const Triangle& other, const Triangle& triangle, double tolerance) {
  std::array<Plane, 3> room;
  return divides(dividers(other, triangle, tolerance, room), triangle, tolerance);
}

bool liesAlong(const Triangle& triangle, const Vec3& from, const Vec3& to, double tolerance) {
  const std::array<Vec3, 2> ends = {from, to};
  const Plane plane = planeOf(triangle);
  const auto [low, high] = heightsOf(plane, ends);
  const double flat = flatness(triangle, ends, tolerance);
  return low >= -flat && high <= flat &&
         isLong(lengthWithin(triangle, plane.normal, from, to, tolerance), tolerance);
}

bool meetOnlyAt(const Vec3& corner, const std::array<Vec3, 2>& of_a, const std::array<Vec3, 2>& of_b,
                double tolerance) {
  const std::array<Vec3, 2> a = {of_a[0] - corner, of_a[1] - corner},
                            b = {of_b[0] - corner, of_b[1] - corner};
  const Vec3 up_a = a[0].cross(a[1]), up_b = b[0].cross(b[1]);
  const std::array<double, 2> of_b_over_a = {up_a.dot(b[0]), up_a.dot(b[1])},
                              of_a_over_b = {up_b.dot(a[0]), up_b.dot(a[1])};
  const double longest =
      std::sqrt(std::max({a[0].squaredNorm(), a[1].squaredNorm(), b[0].squaredNorm(), b[1].squaredNorm()}));
  const double flat_a = 2.0 * tolerance * (up_a.norm() + longest * longest),
               flat_b = 2.0 * tolerance * (up_b.norm() + longest * longest);
  const auto areOnOneSide = [](const std::array<double, 2>& heights, double flat) {
    return (heights[0] > flat && heights[1] > flat) || (heights[0] < -flat && heights[1] < -flat);
  };
  if (areOnOneSide(of_b_over_a, flat_a) || areOnOneSide(of_a_over_b, flat_b)) return true;
  const auto areOffPlane = [](const std::array<double, 2>& heights, double flat) {
    return std::abs(heights[0]) > flat && std::abs(heights[1]) > flat;
  };
  if (areOffPlane(of_b_over_a, flat_a) && areOffPlane(of_a_over_b, flat_b)) {
    // Both cross the line that the planes have in common. They may do so on opposite sides of the corner.
    const Vec3 line = up_a.cross(up_b);
    const auto along = [&](const std::array<Vec3, 2>& ends, const std::array<double, 2>& heights) {
      return (ends[0].dot(line) * heights[1] - ends[1].dot(line) * heights[0]) / (heights[1] - heights[0]);
    };
    const double at_a = along(a, of_a_over_b), at_b = along(b, of_b_over_a);
    const double near = tolerance * line.norm();
    return (at_a > near && at_b < -near) || (at_a < -near && at_b > near);
  }
  // In one plane, an edge separates them.
  constexpr double kClear = 2e-4;  // a sine: less than 1e4 tolerances of an edge are within the tolerance
  const auto separates = [&](const std::array<Vec3, 2>& edges, const Vec3& up,
                             const std::array<Vec3, 2>& others) {
    for (const std::size_t edge : {0u, 1u}) {
      const Vec3 outward = (edge == 0 ? 1.0 : -1.0) * edges[edge].cross(up);
      const auto isBeyond = [&](const Vec3& other) {
        return outward.dot(other) > kClear * outward.norm() * other.norm();
      };
      if (isBeyond(others[0]) && isBeyond(others[1])) return true;
    }
    return false;
  };
  return separates(a, up_a, b) || separates(b, up_b, a);
}

std::optional<std::vector<TrianglePiece>> piecesBetween(const Triangle& triangle,
                                                        std::vector<Triangle> others, double tolerance) {
  // Triangles that pass through one after the other take n log n tests, those that all cross each other n³.
  // The factor leaves room for some that cross.
  const auto n = static_cast<double>(others.size());
  const double most_tests = 1024.0 + 64.0 * n * std::log2(1.0 + n);
  Eigen::Index axis;
  Aabb bounds;
  for (const Vec3& corner : triangle) bounds.extend(corner);
  bounds.halfExtents().maxCoeff(&axis);
  // In the order along the triangle, so that the middle one of several leaves half of them on each side.
  std::ranges::stable_sort(others, {},
                           [axis](const Triangle& t) { return t[0][axis] + t[1][axis] + t[2][axis]; });
  struct Part {
    TrianglePiece piece;
    std::vector<std::uint32_t> cut_by;  // perhaps
  };
  std::vector<std::uint32_t> all(others.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<Part> parts = {{TrianglePiece(triangle.begin(), triangle.end()), std::move(all)}};
  std::vector<TrianglePiece> pieces;
  for (double tests = 0.0; !parts.empty();) {
    if (tests > most_tests) return std::nullopt;
    Part part = std::move(parts.back());
    parts.pop_back();
    tests += static_cast<double>(part.cut_by.size());
    std::array<Plane, 3> room;
    std::erase_if(part.cut_by, [&](std::uint32_t other) {
      return !divides(dividers(others[other], part.piece, tolerance, room), part.piece, tolerance);
    });
    if (part.cut_by.empty()) {
      pieces.push_back(std::move(part.piece));
      continue;
    }
    const auto middle = part.cut_by.begin() + static_cast<std::ptrdiff_t>(part.cut_by.size() / 2);
    const std::span<const Plane> planes = dividers(others[*middle], part.piece, tolerance, room);
    part.cut_by.erase(middle);
    for (TrianglePiece& piece : dividedBy(planes, part.piece, tolerance))
      parts.push_back({std::move(piece), part.cut_by});
  }
  return pieces;
}

}  // namespace octoblisk::detail
