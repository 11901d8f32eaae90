// Where a line crosses a triangle, decided exactly.
#pragma once

#include <optional>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct LineCrossing {
  double t = 0.0;          ///< >= 0; within 1e-9 of its part of the true one
  bool back_face = false;  ///< direction · scaledNormal(triangle) > 0
};

/// Whether origin + t · direction crosses the triangle, its border included, at a t >= 0, in exact arithmetic
/// on the numbers as given; none for a triangle without area or in a plane with the line.
std::optional<LineCrossing> crossing(const Vec3& origin, const Vec3& direction, const Triangle& triangle);

}  // namespace octoblisk::detail
