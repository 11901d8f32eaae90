// Exact signs of determinants: the ground that "misses nothing" stands on.
//
// A floating-point filter (J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates, 1997) decides nearly all calls; where it can't, the determinant is summed in
// integers. Exact for all coordinates of magnitude up to 1e15, however small.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// The sign of (b−a)×(c−a)·(d−a): +1 where d lies on the side of the plane abc that its normal points to,
/// −1 on the other side, 0 in the plane (and for every d where a, b, c are collinear).
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The sign of direction·(a−origin)×(b−origin): +1 where a line, seen against its direction, has the edge
/// from a to b turning left round it, −1 right, 0 where the line meets the edge's line or is parallel to it.
int sideOfLine(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b);

/// The sign of (b−a)×(c−a) in the plane: +1 where a, b, c turn left, −1 right, 0 where they are collinear.
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace octoblisk::detail
