#include "geometry/intersection_curve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace octoblisk::detail {
namespace {

using Segment = IntersectionCurve::Segment;

/// The part of a plane that is in a triangle; none if the triangle is on one side of the plane or in it.
std::optional<Segment> cutOf(const Triangle& triangle, const Vec3& on_plane, const Vec3& normal) {
  std::array<Vec3, 3> ends;
  std::size_t count = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 &from = triangle[v], &to = triangle[(v + 1) % 3];
    const double height = normal.dot(from - on_plane), next = normal.dot(to - on_plane);
    if ((height < 0.0) != (next < 0.0)) ends[count++] = from + (to - from) * (height / (height - next));
  }
  if (count != 2) return std::nullopt;
  return Segment{ends[0], ends[1]};
}

/// The segment in which two triangles meet. A's surface inside B is to its left, seen from outside A.
std::optional<Segment> meetingSegment(const Triangle& a, const Triangle& b) {
  const Vec3 normal_a = scaledNormal(a), normal_b = scaledNormal(b), along = normal_a.cross(normal_b);
  std::optional<Segment> of_a = cutOf(a, b[0], normal_b), of_b = cutOf(b, a[0], normal_a);
  if (!of_a || !of_b) return std::nullopt;
  for (Segment* const segment : {&*of_a, &*of_b}) {
    if (along.dot(segment->to - segment->from) < 0.0) std::swap(segment->from, segment->to);
  }
  const Segment both{along.dot(of_a->from - of_b->from) > 0.0 ? of_a->from : of_b->from,
                     along.dot(of_a->to - of_b->to) < 0.0 ? of_a->to : of_b->to};
  if (!(along.dot(both.to - both.from) > 0.0)) return std::nullopt;
  return both;
}

}  // namespace

void IntersectionCurve::add(const Triangle& a, const Triangle& b) {
  if (const std::optional<Segment> segment = meetingSegment(a, b)) segments_.push_back(*segment);
}

std::optional<Vec3> IntersectionCurve::wayOut() const {
  constexpr double kClosed = 0.01;  // of the length
  constexpr double kWide = 0.005;   // twice the area over the length squared; a circle has 0.16
  double length = 0.0;
  Vec3 twice_area = Vec3::Zero(), end = Vec3::Zero();
  for (const Segment& segment : segments_) {
    const Vec3 from = segment.from - segments_[0].from, to = segment.to - segments_[0].from;
    length += (to - from).norm();
    twice_area += from.cross(to);
    end += to - from;
  }
  const double twice = twice_area.norm();
  if (!(end.norm() <= kClosed * length && twice > kWide * length * length)) return std::nullopt;
  return Vec3(-twice_area / twice);
}

Vec3 IntersectionCurve::middle() const {
  double length = 0.0;
  Vec3 sum = Vec3::Zero();  // relative to a point of the curve
  for (const Segment& segment : segments_) {
    const Vec3 from = segment.from - segments_[0].from, to = segment.to - segments_[0].from;
    const double part = (to - from).norm();
    length += part;
    sum += 0.5 * part * (from + to);
  }
  return segments_[0].from + sum / length;
}

double IntersectionCurve::extentAlong(const Vec3& direction) const {
  const auto height = [&](const Segment& segment) { return direction.dot(segment.from); };
  const auto [low, high] = std::ranges::minmax(segments_, {}, height);
  return height(high) - height(low);
}

}  // namespace octoblisk::detail
