// How deep a triangle lies in the core of a convex body: the expanding polytope algorithm
// (G. van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001).
#pragma once

#include <optional>

#include "geometry/gjk.h"

namespace octoblisk::detail {

/// The shortest translation that parts triangle and core.
struct CorePenetration {
  double depth = 0.0;
  Vec3 normal = Vec3::UnitX();  ///< unit: moving the triangle along it by the depth parts the two
  Vec3 on_triangle = Vec3::Zero();
  Vec3 on_core = Vec3::Zero();
};

/// Grows the simplex that GJK ended with, whatever of it is flat left out first. The depth is that of a plane
/// beyond which nothing of triangle − core reaches: moving by it parts the two, up to 1e-10 of their size or
/// the core's precision, even where rounding or the room for vertices ends the search before its optimum.
/// None where triangle − core is flat (a sphere's centre on the triangle, a capsule's axis in its plane):
/// then the triangle's normal parts them at depth 0.
std::optional<CorePenetration> epa(const Triangle& triangle, const Convex& convex, const Simplex& simplex);

}  // namespace octoblisk::detail
