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

std::span<const Vec3> pointsRoundCore(const Convex& convex, std::array<Vec3, 8>& room) {
  const std::span<const Vec3> points = convex.points();
  if (!points.empty() && points.size() <= kMostPointsRoundCore) return points;
  const Aabb box = convex.coreBounds();
  for (std::size_t c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis)
      room[c][axis] = (c >> axis & 1u) != 0 ? box.max[axis] : box.min[axis];
  }
  return room;
}

}  // namespace octoblisk
