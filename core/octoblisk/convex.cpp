#include "octoblisk/convex.h"

#include <stdexcept>

namespace octoblisk {

ConvexHull::ConvexHull(std::vector<Vec3> points, double radius)
    : points_(std::move(points)), radius_(radius) {
  if (points_.empty()) throw std::invalid_argument("a convex hull needs at least one point");
  if (!(radius_ >= 0.0)) throw std::invalid_argument("the radius of a convex hull must not be negative");
}

Vec3 ConvexHull::support(const Vec3& direction) const { return farthest(points_, direction); }

const Vec3& farthest(std::span<const Vec3> points, const Vec3& direction) {
  const Vec3* found = points.data();
  double most = found->dot(direction);
  for (const Vec3& point : points.subspan(1)) {
    const double along = point.dot(direction);
    if (!(along > most)) continue;
    most = along;
    found = &point;
  }
  return *found;
}

}  // namespace octoblisk
