// The distance from a triangle to the core of a convex body (E. G. Gilbert, D. W. Johnson, S. S. Keerthi,
// 1988; C. Ericson, Real-Time Collision Detection, 9.5).
#pragma once

#include <array>
#include <cstddef>

#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// A point of the Minkowski difference triangle − core, with the two points whose difference it is.
struct SupportPoint {
  Vec3 difference, on_triangle, on_core;
};

/// The farthest point of triangle − core in a direction.
SupportPoint supportOfDifference(const Triangle& triangle, const Convex& convex, const Vec3& direction);

/// Up to four points of the difference.
struct Simplex {
  std::array<SupportPoint, 4> point;
  std::size_t count = 0;
};

struct GjkResult {
  bool overlap = false;       ///< the triangle meets the core; the points are then the last ones found
  bool beyond_limit = false;  ///< the distance is above the limit; the points are then not the closest
  Vec3 on_triangle = Vec3::Zero();
  Vec3 on_core = Vec3::Zero();
  Simplex simplex;  ///< the last simplex of the search; it contains the origin if they overlap
};

/// Triangle and body are in the body's frame. Stops early if the distance is proved to exceed `limit`.
GjkResult gjk(const Triangle& triangle, const Convex& convex, double limit);

}  // namespace octoblisk::detail
