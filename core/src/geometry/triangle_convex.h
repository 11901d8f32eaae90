// A triangle and a convex body: the contact of the two.
#pragma once

#include <optional>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// The contact of a triangle (A) and a convex body (B), both in the body's frame; none where they are farther
/// apart than `threshold`. Where they meet, the distance is minus the length of the shortest translation that
/// parts the triangle from the body.
std::optional<Contact> contactOf(const Triangle& triangle, const Convex& convex, double threshold);

}  // namespace octoblisk::detail
