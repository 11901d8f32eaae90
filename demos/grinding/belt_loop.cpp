#include "grinding/belt_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace octoblisk::demos {
namespace {

double turnAt(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d first = b - a, second = c - a;
  return first.x() * second.y() - first.y() * second.x();
}

}  // namespace

/// Uses A. M. Andrew's monotone chain (Another efficient algorithm for convex hulls in two dimensions, 1979).
BeltLoop::BeltLoop(const TriangleMesh& belt) {
  std::vector<Eigen::Vector2d> points;
  for (const Vec3& vertex : belt.vertices()) points.emplace_back(vertex.x(), vertex.y());
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  // Clockwise: the upper chain from the least x to the greatest, then the lower one back.
  const auto addChain = [&](const auto& in_order) {
    const std::size_t first = corners_.size();
    for (const Eigen::Vector2d& point : in_order) {
      while (corners_.size() >= first + 2 &&
             turnAt(corners_[corners_.size() - 2], corners_.back(), point) >= 0.0)
        corners_.pop_back();
      corners_.push_back(point);
    }
    if (!corners_.empty()) corners_.pop_back();  // it is also the first corner of the next chain
  };
  addChain(points);
  std::ranges::reverse(points);
  addChain(points);
}

Vec3 BeltLoop::directionAt(const Vec3& point) const {
  const Eigen::Vector2d at(point.x(), point.y());
  double nearest = std::numeric_limits<double>::infinity();
  Vec3 direction = Vec3::Zero();
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Eigen::Vector2d& from = corners_[k];
    const Eigen::Vector2d edge = corners_[(k + 1) % corners_.size()] - from;
    const double squared = edge.squaredNorm();
    if (squared == 0.0) continue;
    const double part = std::clamp(edge.dot(at - from) / squared, 0.0, 1.0);
    const double off = (from + part * edge - at).squaredNorm();
    if (off >= nearest) continue;
    nearest = off;
    direction = Vec3(edge.x(), edge.y(), 0.0) / std::sqrt(squared);
  }
  return direction;
}

}  // namespace octoblisk::demos
