#include "octoblisk/convex.h"

#include <stdexcept>

namespace octoblisk {

ConvexHull::ConvexHull(std::vector<Vec3> points, double radius)
    : points_(std::move(points)), radius_(radius) {
  if (points_.empty()) throw std::invalid_argument("a convex hull needs at least one point");
  if (!(radius_ >= 0.0)) throw std::invalid_argument("the radius of a convex hull must not be negative");
  faces_.find(points_);
}

Vec3 ConvexHull::support(const Vec3& direction) const { return farthest(points_, direction); }

ConvexBox::ConvexBox(const Obb& box) : box_(box), points_(box.corners()) {
  std::size_t edge = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 axis = box.axes.col(k);
    const double middle = axis.dot(box.center), half = box.half_extents[k];
    faces_[2 * k] = {-axis, half - middle};
    faces_[2 * k + 1] = {axis, half + middle};
    const std::uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
    for (const std::uint32_t end_i : {0u, 1u}) {
      for (const std::uint32_t end_j : {0u, 1u}) {
        const std::uint32_t from = end_i << i | end_j << j;
        edges_[edge++] = {from, from | 1u << k, 2 * i + end_i, 2 * j + end_j, 0.0};
      }
    }
  }
}

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
