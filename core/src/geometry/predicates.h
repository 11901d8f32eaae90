// Exact signs of determinants, the basis of all exact verdicts.
//
// A floating-point filter (J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates, 1997) decides nearly all calls. If it cannot, the determinant is summed in integers.
// Exact for all coordinates of magnitude up to 1e15, however small.
#pragma once

#include "octoblisk/types.h"

namespace octoblisk::detail {

/// The sign of (b−a)×(c−a)·(d−a): +1 if d is on the side of the plane abc to which its normal points, −1 on
/// the other side, 0 in the plane (and for every d if a, b, c are collinear).
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The sign of direction·(a−origin)×(b−origin). Seen against the line's direction: +1 if the edge from a to b
/// turns left around the line, −1 if right, 0 if the line meets the edge's line or is parallel to it.
int sideOfLine(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b);

/// The sign of (b−a)×(c−a) in the plane: +1 if a, b, c turn left, −1 if right, 0 if they are collinear.
int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace octoblisk::detail
