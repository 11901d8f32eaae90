#include "geometry/triangle_capsule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/closest_point_on_triangle.h"
#include "geometry/segment_pair.h"
#include "geometry/triangle_feature.h"

namespace octoblisk::detail {
namespace {

constexpr double kTouching = 1e-12;  // relative to the size: nearer points have no direction between them

/// The contact of a segment and a triangle.
class SegmentContact {
 public:
  SegmentContact(const Triangle& triangle, const Vec3& from, const Vec3& to)
      : triangle_(triangle),
        end_{from, to},
        facing_(unitNormal(triangle)),
        height_{facing_.dot(from - triangle[0]), facing_.dot(to - triangle[0])} {
    for (const Vec3& corner : triangle) size_ = std::max(size_, (corner - from).norm());
    size_ = std::max(size_, (to - from).norm());
  }

  CoreContact find() const {
    if (goesThrough()) return parted();
    PointPair edges;
    for (std::size_t v = 0; v < 3; ++v)
      closestOnSegments(triangle_[v], triangle_[(v + 1) % 3], end_[0], end_[1], edges);
    const double to_edges = std::sqrt(edges.squared_distance);
    // Of two equally high ends, take the first, so that rounding does not decide for a segment that lies on
    // the triangle.
    std::optional<std::size_t> nearest;
    double least = to_edges;
    for (std::size_t e = 0; e < 2; ++e) {
      const double height = std::abs(height_[e]);
      if (height < least - (nearest ? kTouching * size_ : 0.0) && isOver(triangle_, facing_, end_[e])) {
        nearest = e;
        least = height;
      }
    }
    if (nearest) {
      const double height = height_[*nearest];
      const Vec3 normal = height < 0.0 ? facing_ : Vec3(-facing_);
      return {std::abs(height), normal, end_[*nearest] + std::abs(height) * normal, end_[*nearest]};
    }
    if (!(to_edges > kTouching * size_)) return parted();
    return {to_edges, (edges.on_a - edges.on_b) / to_edges, edges.on_a, edges.on_b};
  }

 private:
  bool goesThrough() const {
    if (height_[0] * height_[1] > 0.0 || height_[0] == height_[1]) return false;
    const Vec3 crossing = end_[0] + (end_[1] - end_[0]) * (height_[0] / (height_[0] - height_[1]));
    return isOver(triangle_, facing_, crossing);
  }

  /// The best of all ways out, which are the sides of triangle − segment: two for the triangle's faces, and
  /// one for each pair of an edge and the segment.
  CoreContact parted() const {
    CoreContact best;
    best.distance = -std::numeric_limits<double>::infinity();
    const Vec3 along = end_[1] - end_[0];
    tryFacing(-facing_, best);
    tryFacing(facing_, best);
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 &from = triangle_[v], &to = triangle_[(v + 1) % 3];
      const Vec3 across = (to - from).cross(along);
      const double length = across.norm();
      if (!(length > kTouching * (to - from).norm() * along.norm())) continue;
      tryEdge(across / length, from, to, best);
      tryEdge(-across / length, from, to, best);
    }
    return best;
  }

  double gapAlong(const Vec3& direction) const {
    const double low =
        std::min({direction.dot(triangle_[0]), direction.dot(triangle_[1]), direction.dot(triangle_[2])});
    return low - std::max(direction.dot(end_[0]), direction.dot(end_[1]));
  }

  void tryFacing(const Vec3& normal, CoreContact& best) const {
    const double gap = gapAlong(normal);
    if (!(gap > best.distance)) return;
    const double rise = normal.dot(end_[1] - end_[0]);
    Vec3 farthest = rise > 0.0 ? end_[1] : end_[0];
    if (std::abs(rise) <= kTouching * size_) farthest = middleOver();
    const Vec3 on_triangle = closestPoint(triangle_, farthest);
    best = {gap, normal, on_triangle, on_triangle - gap * normal};
  }

  void tryEdge(const Vec3& normal, const Vec3& from, const Vec3& to, CoreContact& best) const {
    const double gap = gapAlong(normal);
    if (!(gap > best.distance + kTouching * size_)) return;  // prefer the triangle's normal
    PointPair closest;
    closestOnSegments(from, to, end_[0] + gap * normal, end_[1] + gap * normal, closest);
    best = {gap, normal, closest.on_a, closest.on_a - gap * normal};
  }

  /// The middle of the part of a parallel segment that is over the triangle.
  Vec3 middleOver() const {
    double first = 0.0, last = 1.0;
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 inward = facing_.cross(triangle_[(v + 1) % 3] - triangle_[v]);
      const double start = inward.dot(end_[0] - triangle_[v]), end = inward.dot(end_[1] - triangle_[v]);
      if (start < 0.0 && end > start) first = std::max(first, start / (start - end));
      if (end < 0.0 && start > end) last = std::min(last, start / (start - end));
    }
    const double middle = std::clamp(0.5 * (first + last), 0.0, 1.0);
    return end_[0] + middle * (end_[1] - end_[0]);
  }

  const Triangle& triangle_;
  const std::array<Vec3, 2> end_;
  const Vec3 facing_;
  const std::array<double, 2> height_;
  double size_ = 0.0;
};

}  // namespace

CoreContact contactOfPoint(const Triangle& triangle, const Vec3& point) {
  const Vec3 scaled = scaledNormal(triangle);
  const auto [closest, is_foot] = closestPointOf(triangle, scaled, point);
  const Vec3 apart = closest - point;
  const double squared = apart.squaredNorm();
  // If the point is nearer than the triangle is wide, the triangle's normal is more accurate than the
  // difference of two points.
  const bool is_near = is_foot && squared * squared < scaled.squaredNorm();
  if (is_near || squared <= kTouching * kTouching * (point - triangle[0]).squaredNorm()) {
    const Vec3 facing = scaled.isZero(0.0) ? Vec3(Vec3::UnitX()) : scaled.stableNormalized().normalized();
    const double height = facing.dot(is_near ? Vec3(point - triangle[0]) : Vec3(-apart));
    const Vec3 normal = height < 0.0 ? facing : Vec3(-facing);
    return {std::abs(height), normal, closest, closest - std::abs(height) * normal};
  }
  const double distance = std::sqrt(squared);
  return {distance, apart / distance, closest, point};
}

CoreContact contactOfSegment(const Triangle& triangle, const Vec3& from, const Vec3& to) {
  return SegmentContact(triangle, from, to).find();
}

}  // namespace octoblisk::detail
