#include "contact/point_in_solid.h"

#include <limits>

#include "octoblisk/closest_point.h"

namespace octoblisk::detail {

bool PointInSolid::contains(const SolidMesh& solid, const Vec3& point, FunctionRef<double()> leastClearance) {
  const bool is_first = !last_;
  const double moved = is_first ? std::numeric_limits<double>::infinity() : (point - *last_).norm();
  last_ = point;
  clearance_ -= moved;
  if (!solid.boundary().mesh().bounds().meets({point, point})) return is_inside_ = false;
  // Through a hole, a point gets into a solid without crossing the surface.
  if (!solid.isClosed()) return is_inside_ = solid.contains(point);
  if (clearance_ > 0.0) return is_inside_;
  clearance_ = leastClearance();
  if (moved < clearance_) return is_inside_;
  is_inside_ = solid.contains(point);
  // A single test does not need the clearance.
  if (!is_first && clearance_ <= 0.0) clearance_ = closestPoint(solid.boundary(), point)->distance;
  return is_inside_;
}

}  // namespace octoblisk::detail
