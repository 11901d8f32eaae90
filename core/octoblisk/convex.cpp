#include "octoblisk/convex.h"

#include <algorithm>
#include <stdexcept>

namespace octoblisk {

ConvexHull::ConvexHull(std::vector<Vec3> points, double radius)
    : points_(std::move(points)), radius_(radius) {
  if (points_.empty()) throw std::invalid_argument("a convex hull needs at least one point");
  if (!(radius_ >= 0.0)) throw std::invalid_argument("the radius of a convex hull must not be negative");
}

Vec3 ConvexHull::support(const Vec3& direction) const {
  return *std::ranges::max_element(points_, {}, [&](const Vec3& point) { return point.dot(direction); });
}

}  // namespace octoblisk
