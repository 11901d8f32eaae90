#include "geometry/intersection_curve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace octoblisk::detail {
namespace {

struct Ends {
  Vec3 from, to;
};

double lengthOf(IntersectionCurve curve) {
  double length = 0.0;
  for (const CurveSegment& segment : curve) length += (segment.to - segment.from).norm();
  return length;
}

/// The part of a plane that is in a triangle; none if the triangle is on one side of the plane or in it.
std::optional<Ends> cutOf(const Triangle& triangle, const Vec3& on_plane, const Vec3& normal) {
  std::array<double, 3> height;
  std::ranges::transform(triangle, height.begin(),
                         [&](const Vec3& corner) { return normal.dot(corner - on_plane); });
  std::array<Vec3, 2> ends;
  std::size_t count = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    const std::size_t next = (v + 1) % 3;
    if ((height[v] < 0.0) == (height[next] < 0.0)) continue;
    ends[count++] = triangle[v] + (triangle[next] - triangle[v]) * (height[v] / (height[v] - height[next]));
  }
  if (count != 2) return std::nullopt;
  return Ends{ends[0], ends[1]};
}

}  // namespace

std::optional<CurveSegment> meetingSegment(const Triangle& a, const Triangle& b) {
  const Vec3 normal_a = scaledNormal(a), normal_b = scaledNormal(b), along = normal_a.cross(normal_b);
  std::optional<Ends> of_a = cutOf(a, b[0], normal_b), of_b = cutOf(b, a[0], normal_a);
  if (!of_a || !of_b) return std::nullopt;
  for (Ends* const segment : {&*of_a, &*of_b}) {
    if (along.dot(segment->to - segment->from) < 0.0) std::swap(segment->from, segment->to);
  }
  const Ends both{along.dot(of_a->from - of_b->from) > 0.0 ? of_a->from : of_b->from,
                  along.dot(of_a->to - of_b->to) < 0.0 ? of_a->to : of_b->to};
  if (!(along.dot(both.to - both.from) > 0.0)) return std::nullopt;
  return CurveSegment{both.from, both.to, normal_a, normal_b};
}

std::optional<Vec3> wayOut(IntersectionCurve curve) {
  constexpr double kClosed = 0.01;  // of the length
  constexpr double kWide = 0.005;   // twice the area over the length squared; a circle has 0.16
  const double length = lengthOf(curve);
  Vec3 twice_area = Vec3::Zero(), end = Vec3::Zero();
  for (const CurveSegment& segment : curve) {
    const Vec3 from = segment.from - curve[0].from, to = segment.to - curve[0].from;
    twice_area += from.cross(to);
    end += to - from;
  }
  const double twice = twice_area.norm();
  if (!(end.norm() <= kClosed * length && twice > kWide * length * length)) return std::nullopt;
  return Vec3(-twice_area / twice);
}

Vec3 middleOf(IntersectionCurve curve) {
  double length = 0.0;
  Vec3 sum = Vec3::Zero();  // relative to a point of the curve
  for (const CurveSegment& segment : curve) {
    const Vec3 from = segment.from - curve[0].from, to = segment.to - curve[0].from;
    const double part = (to - from).norm();
    length += part;
    sum += 0.5 * part * (from + to);
  }
  return curve[0].from + sum / length;
}

double extentAlong(const Vec3& way_out, IntersectionCurve curve) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const CurveSegment& segment : curve) {
    for (const Vec3& end : {segment.from, segment.to}) {
      low = std::min(low, way_out.dot(end));
      high = std::max(high, way_out.dot(end));
    }
  }
  return high - low;
}

double depthAlong(const Vec3& way_out, IntersectionCurve curve) {
  constexpr double kParallel = 1e-3;  // a sine; faces along the way out do not bound the overlap on it
  const Vec3 middle = middleOf(curve);
  double low = -std::numeric_limits<double>::infinity(), high = -low;  // on the line, from the middle
  for (const CurveSegment& segment : curve) {
    for (const Vec3& normal : {segment.normal_a, segment.normal_b}) {
      const double along = normal.dot(way_out), height = normal.dot(segment.from - middle);
      if (along < -kParallel * normal.norm()) low = std::max(low, height / along);
      if (along > kParallel * normal.norm()) high = std::min(high, height / along);
    }
  }
  return high - low;
}

}  // namespace octoblisk::detail
