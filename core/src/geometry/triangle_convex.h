// The contact between a triangle and a convex body.
#pragma once

#include <optional>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The contact of a triangle (A) and a convex body (B), both in the body's frame; none if they are farther
/// apart than `threshold`. If they meet, the distance is minus the length of the shortest translation that
/// separates the triangle from the body.
std::optional<Contact> contactOf(const Triangle& triangle, const Convex& convex, double threshold);

}  // namespace octoblisk::detail
