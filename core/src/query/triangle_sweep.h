// The time of impact of a moving convex body on one triangle.
#pragma once

#include <optional>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/motion.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

struct TriangleImpact {
  double fraction;  ///< of the motion
  Contact contact;  ///< at this fraction; the triangle is A
};

/// The first fraction of B's motion at which it is at most `distance` from the triangle, up to `tolerance`;
/// none if that is not before `until`, or if B comes no nearer later: a motion may end or slide at the
/// distance. A motion without length has its impact at 0 if it is at the distance. Distances are signed like
/// those of contactOf: if `distance` is negative, the bodies may overlap by it.
///
/// Conservative advancement by the speed along the way that separates the two (G. van den Bergen, Ray casting
/// against general convex objects, 2004). Allocates nothing.
std::optional<TriangleImpact> sweep(const Triangle& triangle, const Convex& b, const Motion& b_in_a,
                                    double distance, double tolerance, double until);

}  // namespace octoblisk::detail
