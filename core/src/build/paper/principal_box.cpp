#include "build/paper/principal_box.h"

#include <stdexcept>

#include "geometry/bounding_box.h"
#include "geometry/principal_axes.h"

namespace octoblisk::detail {

Mat3 covariance(std::span<const Vec3> points) {
  if (points.empty()) throw std::invalid_argument("the covariance of no points is undefined");
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Mat3 sum = Mat3::Zero();
  for (const Vec3& point : points) sum += (point - mean) * (point - mean).transpose();
  return points.size() == 1 ? sum : Mat3(sum / static_cast<double>(points.size() - 1));
}

Obb principalBox(std::span<const Vec3> points) {
  return boundingBox(points, principalAxes(covariance(points)));
}

}  // namespace octoblisk::detail
