// The penetration depth of a triangle in the core of a convex body, by the expanding polytope algorithm (G.
// van den Bergen, Proximity Queries and Penetration Depth Computation on 3D Game Objects, 2001).
#pragma once

#include <optional>

#include "geometry/core_contact.h"
#include "geometry/gjk.h"

namespace octoblisk::detail {

/// Expands GJK's last simplex, after removing its flat part. The distance is at most 0. The depth, which is
/// minus the distance, is that of a plane that bounds triangle − core. A translation by the depth separates
/// the two, up to 1e-10 of their size or the core's precision, even if rounding or the vertex limit ends the
/// search before the optimum. None if triangle − core is flat (a sphere's centre on the triangle, a capsule's
/// axis in its plane): then the triangle's normal separates them at depth 0.
std::optional<CoreContact> epa(const Triangle& triangle, const Convex& convex, const Simplex& simplex);

}  // namespace octoblisk::detail
