#include "contact/point_in_solid.h"

#include <limits>

#include "octoblisk/closest_point.h"
#include "query/winding.h"

namespace octoblisk::detail {

bool isInSolid(const ClusteredOctree& tree, const Vec3& point) {
  const Aabb& bounds = tree.mesh().bounds();
  if (!bounds.meets({point, point})) return false;
  // Usually, the shortest way out of the bounds meets the fewest boxes.
  Eigen::Index axis_down, axis_up;
  const double down = (point - bounds.min).minCoeff(&axis_down), up = (bounds.max - point).minCoeff(&axis_up);
  const Eigen::Index axis = down < up ? axis_down : axis_up;
  const double sense = down < up ? -1.0 : 1.0;
  Pose turn{Mat3::Zero(), Vec3::Zero()};  // by right angles, so without rounding; the way out becomes +x
  turn.rotation(0, axis) = turn.rotation(1, (axis + 1) % 3) = sense;
  turn.rotation(2, (axis + 2) % 3) = 1.0;
  return crossingNumber(tree, turn * point, turn).value_or(0) != 0;
}

bool PointInSolid::contains(const ClusteredOctree& tree, const Vec3& point,
                            FunctionRef<double()> leastClearance) {
  const bool is_first = !last_;
  const double moved = is_first ? std::numeric_limits<double>::infinity() : (point - *last_).norm();
  last_ = point;
  clearance_ -= moved;
  if (!tree.mesh().bounds().meets({point, point})) return is_inside_ = false;
  if (clearance_ > 0.0) return is_inside_;
  clearance_ = leastClearance();
  if (moved < clearance_) return is_inside_;
  is_inside_ = isInSolid(tree, point);
  // A single test does not need the clearance.
  if (!is_first && clearance_ <= 0.0) clearance_ = closestPoint(tree, point)->distance;
  return is_inside_;
}

}  // namespace octoblisk::detail
