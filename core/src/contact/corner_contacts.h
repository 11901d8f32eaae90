// Where a convex body stands on a triangle: on all its corners over it, not on the deepest alone.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends to the contacts of a mesh (A) and a convex body (B) those of the body's corners (Convex::points;
/// the ends of a capsule) that are over, or in, a triangle of one of the contacts whose normal is the
/// triangle's, no farther from it than `threshold`. Contacts are in the mesh's frame. Where `contacts` has
/// the room, allocates nothing.
void addCornerContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                       double threshold, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
