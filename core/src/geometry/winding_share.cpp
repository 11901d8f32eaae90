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

/// The number of triangles that are summed up as fast as two nodes are estimated.
constexpr std::size_t kFew = 4;

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

WindingShare::WindingShare(std::vector<std::vector<Triangle>> caps) {
  std::erase_if(caps, [](const std::vector<Triangle>& cap) { return cap.empty(); });
  if (!caps.empty()) divide(caps);
}

/// Adds a node over caps, divided in two by place.
void WindingShare::divide(std::span<std::vector<Triangle>> caps) {
  const auto begin = static_cast<std::uint32_t>(triangles_.size());
  if (caps.size() == 1) {
    triangles_.insert(triangles_.end(), caps[0].begin(), caps[0].end());
    halve(begin, static_cast<std::uint32_t>(triangles_.size()));
    return;
  }
  const std::size_t index = nodes_.size(), middle = caps.size() / 2;
  nodes_.emplace_back();
  const auto placeOf = [](const std::vector<Triangle>& cap) { return centroidOf(cap.front()); };
  Aabb bounds;
  for (const std::vector<Triangle>& cap : caps) bounds.extend(placeOf(cap));
  Eigen::Index axis;
  bounds.halfExtents().maxCoeff(&axis);
  // Not std::nth_element, whose order depends on the standard library.
  std::ranges::stable_sort(caps, {}, [&](const std::vector<Triangle>& cap) { return placeOf(cap)[axis]; });
  divide(caps.first(middle));
  const auto second_child = static_cast<std::uint32_t>(nodes_.size());
  divide(caps.subspan(middle));
  nodes_[index] = nodeOver(begin, static_cast<std::uint32_t>(triangles_.size()));
  if (triangles_.size() - begin > kFew) {
    nodes_[index].second_child = second_child;
  } else {
    nodes_.resize(index + 1);  // few triangles need no children
  }
}

/// Adds a node over triangles of one cap.
void WindingShare::halve(std::uint32_t begin, std::uint32_t end) {
  const std::size_t index = nodes_.size();
  nodes_.push_back(nodeOver(begin, end));
  if (end - begin <= kFew) return;
  const std::uint32_t middle = begin + (end - begin + 1) / 2;
  halve(begin + 1, middle);
  nodes_[index].second_child = static_cast<std::uint32_t>(nodes_.size());
  halve(middle, end);
}

WindingShare::Node WindingShare::nodeOver(std::uint32_t begin, std::uint32_t end) const {
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
      const Vec3 away = corner - node.center;
      radius = std::max(radius, away.norm());
      squares += away.squaredNorm();
      node.half_extents = node.half_extents.cwiseMax(away.cwiseAbs());
    }
    node.second_moment += area * squares / 12.0;
    if (area > 0.0) node.first_moment += area * radius * (unitNormal(triangles_[t]) - mean_normal).norm();
  }
  return node;
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
  const auto estimateOf = [&](std::uint32_t index) {
    const Node& node = nodes_[index];
    const Vec3 way = node.center - local;
    const double square = (way.cwiseAbs() - node.half_extents).cwiseMax(0.0).squaredNorm();
    // No triangle takes up more than half of all directions.
    const double at_most =
        std::min(0.5 * static_cast<double>(node.end - node.begin), node.area / (kAllDirections * square));
    // The density of the share is n·x/|x|³. The first derivative of x/|x|³ is at most 2/|x|³, the second
    // 6/|x|⁴. The mean normal cancels the first, because the center is the mean.
    const double error = (2.0 * node.first_moment * std::sqrt(square) + 3.0 * node.second_moment) /
                         (kAllDirections * square * square);
    if (!(error < at_most)) return Estimate{0.0, at_most, index};  // also if the error is not a number
    const double length = way.norm();
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
    if (node.second_child == 0 || count + 2 > heap.size()) {
      share += sumOf(node.begin, node.end, point, triangles_in_a);
      continue;
    }
    share += sumOf(node.begin, nodes_[worst.node + 1].begin, point, triangles_in_a);
    push(estimateOf(worst.node + 1));
    push(estimateOf(node.second_child));
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
