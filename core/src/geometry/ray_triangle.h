// Where a line crosses a triangle; the decision is exact.
#pragma once

#include <optional>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct LineCrossing {
  double t = 0.0;          ///< >= 0; relative error at most 1e-9
  bool back_face = false;  ///< direction · scaledNormal(triangle) > 0
};

/// Whether origin + t · direction crosses the triangle, border included, at a t >= 0, in exact arithmetic on
/// the given numbers. None for a triangle without area or in a plane with the line.
std::optional<LineCrossing> crossing(const Vec3& origin, const Vec3& direction, const Triangle& triangle);

}  // namespace octoblisk::detail
