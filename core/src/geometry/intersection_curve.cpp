#include "geometry/intersection_curve.h"

#include <array>
#include <cstddef>
#include <utility>

namespace octoblisk::detail {
namespace {

struct Segment {
  Vec3 from, to;
};

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
  const std::optional<Segment> segment = meetingSegment(a, b);
  if (!segment) return;
  if (length_ == 0.0) first_ = segment->from;
  const Vec3 from = segment->from - first_, to = segment->to - first_;
  const double length = (to - from).norm();
  length_ += length;
  sum_ += 0.5 * length * (from + to);
  area_ += from.cross(to);
  end_ += to - from;
}

std::optional<Vec3> IntersectionCurve::wayOut() const {
  constexpr double kClosed = 0.01;  // of the length
  constexpr double kWide = 0.01;    // of the length squared; a circle has 0.16
  const double area = area_.norm();
  if (!(end_.norm() <= kClosed * length_ && area > kWide * length_ * length_)) return std::nullopt;
  return Vec3(-area_ / area);
}

}  // namespace octoblisk::detail
