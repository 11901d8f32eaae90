#include "geometry/winding_share.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/half_line_crossing.h"
#include "geometry/predicates.h"

namespace octoblisk::detail {
namespace {

constexpr double kAllDirections = 4.0 * std::numbers::pi;

/// The share of one triangle (A. Van Oosterom, J. Strackee, The solid angle of a plane triangle, IEEE Trans.
/// Biomed. Eng. 30 (2), 1983).
double shareOf(const Triangle& triangle, const Vec3& point) {
  const Vec3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double cosine = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  double sine = a.dot(b.cross(c));
  if (cosine < 0.0) {  // close to the triangle, the exact side decides
    const int side = orient3d(triangle[0], triangle[1], triangle[2], point);
    sine = std::copysign(sine, side != 0 ? -side : -sideInPlane(scaledNormal(triangle)));
  }
  return 2.0 * std::atan2(sine, cosine) / kAllDirections;
}

}  // namespace

WindingShare::WindingShare(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void WindingShare::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t index = nodes_.size();
  Node node{.begin = begin, .end = end};
  Aabb bounds;
  Vec3 moment = Vec3::Zero();
  for (std::uint32_t t = begin; t < end; ++t) {
    const Vec3 area_vector = 0.5 * scaledNormal(triangles_[t]);
    node.area += area_vector.norm();
    node.area_vector += area_vector;
    moment += area_vector.norm() * centroidOf(triangles_[t]);
    bounds.extend(centroidOf(triangles_[t]));
  }
  node.center = node.area > 0.0 ? Vec3(moment / node.area) : bounds.center();
  const Vec3 mean_normal = node.area > 0.0 ? Vec3(node.area_vector / node.area) : Vec3(Vec3::Zero());
  for (std::uint32_t t = begin; t < end; ++t) {
    const double area = 0.5 * scaledNormal(triangles_[t]).norm();
    double radius = 0.0, squares = 9.0 * (centroidOf(triangles_[t]) - node.center).squaredNorm();
    for (const Vec3& corner : triangles_[t]) {
      radius = std::max(radius, (corner - node.center).norm());
      squares += (corner - node.center).squaredNorm();
    }
    node.radius = std::max(node.radius, radius);
    node.second_moment += area * squares / 12.0;
    if (area > 0.0) node.first_moment += area * radius * (unitNormal(triangles_[t]) - mean_normal).norm();
  }
  nodes_.push_back(node);
  if (end - begin == 1) return;
  Eigen::Index axis;
  bounds.halfExtents().maxCoeff(&axis);
  const auto at = [&](std::uint32_t t) { return triangles_.begin() + static_cast<std::ptrdiff_t>(t); };
  std::iter_swap(at(begin), std::max_element(at(begin), at(end), [](const Triangle& s, const Triangle& t) {
                   return scaledNormal(s).squaredNorm() < scaledNormal(t).squaredNorm();
                 }));
  ++begin;
  const std::uint32_t middle = begin + (end - begin + 1) / 2;
  // Not std::nth_element, whose order depends on the standard library.
  std::stable_sort(at(begin), at(end), [&](const Triangle& s, const Triangle& t) {
    return centroidOf(s)[axis] < centroidOf(t)[axis];
  });
  build(begin, middle);
  if (middle == end) return;
  nodes_[index].second_child = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

double WindingShare::sumOf(std::uint32_t begin, std::uint32_t end, const Vec3& point,
                           const Pose& triangles_in_a) const {
  double sum = 0.0;
  for (std::uint32_t t = begin; t < end; ++t) sum += shareOf(triangles_in_a * triangles_[t], point);
  return sum;
}

/// Replaces the least certain node by its children until is_enough(share, error) is true, or nothing is
/// uncertain.
template <typename IsEnough>
double WindingShare::refined(const Vec3& point, const Pose& triangles_in_a, const IsEnough& is_enough) const {
  struct Estimate {
    double share, error;
    std::uint32_t node;
  };
  if (nodes_.empty()) return 0.0;
  const Vec3 local = triangles_in_a.inverse() * point;
  constexpr double kUncertain = 16.0;  // whatever is near counts as uncertain, by more than is ever enough
  const auto estimateOf = [&](std::uint32_t index) {
    const Node& node = nodes_[index];
    const Vec3 way = node.center - local;
    const double length = way.norm(), least = length - node.radius;
    if (!(least > 0.0)) return Estimate{0.0, kUncertain, index};
    // The density of the share is n·x/|x|³. The first derivative of x/|x|³ is at most 2/|x|³, the second
    // 6/|x|⁴. The mean normal cancels the first, because the center is the mean.
    const double error = (2.0 * node.first_moment + 3.0 * node.second_moment / least) /
                         (kAllDirections * least * least * least);
    if (!(error < kUncertain)) return Estimate{0.0, kUncertain, index};
    return Estimate{node.area_vector.dot(way) / (kAllDirections * length * length * length), error, index};
  };
  const auto isMoreCertain = [](const Estimate& a, const Estimate& b) { return a.error < b.error; };
  std::array<Estimate, 256> heap;
  std::size_t count = 0;
  double share = 0.0, error = 0.0;
  const auto push = [&](const Estimate& estimate) {
    share += estimate.share;
    error += estimate.error;
    heap[count++] = estimate;
    std::push_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(count), isMoreCertain);
  };
  push(estimateOf(0));
  while (count > 0 && !is_enough(share, error)) {
    std::pop_heap(heap.begin(), heap.begin() + static_cast<std::ptrdiff_t>(count), isMoreCertain);
    const Estimate worst = heap[--count];
    share -= worst.share;
    error -= worst.error;
    const Node& node = nodes_[worst.node];
    if (count + 2 > heap.size()) {
      share += sumOf(node.begin, node.end, point, triangles_in_a);
      continue;
    }
    share += shareOf(triangles_in_a * triangles_[node.begin], point);
    if (node.end - node.begin > 1) push(estimateOf(worst.node + 1));
    if (node.second_child != 0) push(estimateOf(node.second_child));
  }
  return share;
}

double WindingShare::at(const Vec3& point, const Pose& triangles_in_a) const {
  return sumOf(0, static_cast<std::uint32_t>(triangles_.size()), point, triangles_in_a);
}

int WindingShare::roundedAt(const Vec3& point, const Pose& triangles_in_a) const {
  const double share = refined(point, triangles_in_a, [](double estimate, double error) {
    return std::abs(estimate - std::round(estimate)) + error < 0.5;
  });
  return std::isfinite(share) ? static_cast<int>(std::round(share))
                              : 0;  // nothing encloses a point at infinity
}

bool WindingShare::exceeds(double limit, const Vec3& point) const {
  return std::abs(refined(point, Pose(), [limit](double share, double error) {
           return std::abs(std::abs(share) - limit) > error;
         })) > limit;
}

}  // namespace octoblisk::detail
