// The nearest pair of triangles found so far, and how near another must be to matter.
#pragma once

#include "octoblisk/distance.h"
#include "octoblisk/traversal_stack.h"
#include "octoblisk/triangle_pair.h"

namespace octoblisk {

class Nearest {
 public:
  Nearest(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a, const DistanceOptions& options)
      : a_(a), b_(b), b_in_a_(b_in_a), tolerance_(options.tolerance) {
    best_.distance = options.upper_bound;
  }

  /// Takes the pair if it is nearer; `may_meet`: the two may touch. Returns true where nothing can be nearer.
  bool offer(const TrianglePair& pair, bool may_meet) {
    const Triangle triangle_a = a_.triangle(pair.a), triangle_b = b_in_a_ * b_.triangle(pair.b);
    const bool meet = may_meet && intersects(triangle_a, triangle_b);
    const Contact contact = meet ? contactOf(triangle_a, triangle_b) : closestPoints(triangle_a, triangle_b);
    const double distance = meet ? 0.0 : contact.distance;
    if (distance < best_.distance) {
      best_ = {distance, contact.point_on_a, contact.point_on_b, pair.a, pair.b};
      if (meet) best_.point_on_a = best_.point_on_b;
      updateLimit();
    }
    return distance == 0.0;
  }

  /// The sizes that set the rounding of the comparisons.
  void setSize(double size) {
    size_ = size;
    updateLimit();
  }

  /// What is farther than this in single precision is not nearer than the best.
  float limit() const { return limit_; }
  float squaredLimit() const { return squared_limit_; }

  const Clearance& clearance() const { return best_; }

 private:
  void updateLimit() {
    limit_ = traversalLimit(std::max(0.0, std::min(best_.distance - tolerance_, kFarthestDistance)), size_);
    squared_limit_ = limit_ * limit_;
  }

  // Its square is below that of the distance to empty boxes.
  static constexpr double kFarthestDistance = 1e18;

  const TriangleMesh &a_, &b_;
  const Pose& b_in_a_;
  const double tolerance_;
  double size_ = 0.0;
  float limit_ = 0.0f, squared_limit_ = 0.0f;
  Clearance best_;
};

}  // namespace octoblisk
