#include "octoblisk/closest_point.h"

#include <algorithm>

#include "octoblisk/traversal.h"

namespace octoblisk {
namespace {

Vec3 closestOnSegment(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double squared = along.squaredNorm();
  if (!(squared > 0.0)) return from;
  const double part = along.dot(point - from) / squared;
  if (part <= 0.0) return from;
  if (part >= 1.0) return to;
  return from + part * along;
}

/// The distances from a point, in the tree's local frame, to eight boxes; infinite for the empty ones.
Float8 distances(const Box8& boxes, const Eigen::Vector3f& point) {
  const Float8 x = point.x() - boxes.center[0], y = point.y() - boxes.center[1],
               z = point.z() - boxes.center[2];
  Float8 squared = Float8::Zero();
  for (int j = 0; j < 3; ++j) {
    const Float8 along = x * boxes.axes[0][j] + y * boxes.axes[1][j] + z * boxes.axes[2][j];
    const Float8 outside = (along.abs() - boxes.half_extents[j]).max(0.0f);
    squared += outside * outside;
  }
  return squared.sqrt();
}

}  // namespace

Vec3 closestPoint(const Triangle& triangle, const Vec3& point) {
  const Vec3 normal = scaledNormal(triangle);
  const double squared = normal.squaredNorm();
  const double longest =
      std::max((triangle[1] - triangle[0]).squaredNorm(), (triangle[2] - triangle[0]).squaredNorm());
  constexpr double kFlat = 1e-24;  // of sin²: below, the normal is mostly rounding
  const bool flat = !(squared > kFlat * longest * longest);
  // The closest point is the foot on the plane, or lies on an edge that the foot is beyond.
  Vec3 closest = triangle[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = triangle[i], &to = triangle[(i + 1) % 3];
    if (!flat && normal.cross(to - from).dot(point - from) >= 0.0) continue;
    const Vec3 candidate = closestOnSegment(from, to, point);
    const double distance = (candidate - point).squaredNorm();
    if (distance < least) {
      least = distance;
      closest = candidate;
    }
  }
  if (least < std::numeric_limits<double>::infinity()) return closest;
  return point - normal * (normal.dot(point - triangle[0]) / squared);
}

std::optional<ClosestPoint> closestPoint(const ClusteredOctree& tree, const Vec3& point, double upper_bound) {
  struct Entry {
    Child child;
    float gap;
    Entry() = default;
    Entry(Child at, float distance) : child(at), gap(distance) {}
  };
  const Vec3 local = point - tree.origin();
  const Eigen::Vector3f local_single = local.cast<float>();
  const double farthest = local.norm() + tree.radius();  // no triangle is farther
  const double rounding = kTraversalRounding * farthest;
  ClosestPoint best;
  best.distance = std::min(upper_bound, 2.0 * farthest);
  auto limit = static_cast<float>(best.distance + rounding);

  TraversalStack<Entry, ClusteredOctree::kMaxDepth> stack;
  stack.pushSorted(0, {tree.child(ClusteredOctree::kRoot), 0.0f});
  while (!stack.empty()) {
    const Entry entry = stack.pop();
    if (entry.gap > limit) continue;
    if (entry.child.isLeaf()) {
      for (const std::uint32_t t : tree.triangles(entry.child)) {
        const Vec3 on_triangle = closestPoint(tree.mesh().triangle(t), point);
        const double distance = (on_triangle - point).norm();
        if (distance < best.distance || (distance == best.distance && t < best.triangle)) {
          best = {on_triangle, distance, t};
        }
      }
      limit = static_cast<float>(best.distance + rounding);
      continue;
    }
    const ClusteredOctree::Node& node = tree.nodes()[entry.child.node()];
    const Float8 distance = distances(node.boxes, local_single);
    const std::size_t first = stack.size();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (distance[static_cast<Eigen::Index>(lane)] <= limit && !node.children[lane].isEmpty()) {
        stack.pushSorted(first, {node.children[lane], distance[static_cast<Eigen::Index>(lane)]});
      }
    }
  }
  if (best.triangle == kNoTriangle) return std::nullopt;
  return best;
}

}  // namespace octoblisk
