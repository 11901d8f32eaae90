// The oriented bounding box of a point cloud by principal component analysis (eq. 1–3 of the paper).
#pragma once

#include <span>

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// The covariance of the points, with divisor n − 1 (eq. 2–3); zero for one point. Throws
/// std::invalid_argument if there are no points.
Mat3 covariance(std::span<const Vec3> points);

/// boundingBox in the principal axes of the points' covariance. It contains the points, but not a surface
/// that bulges between them, and it is not the smallest box (errata 7 and 14).
Obb principalBox(std::span<const Vec3> points);

}  // namespace octoblisk::detail
