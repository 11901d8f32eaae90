// Where a face of a convex body lies flat on a triangle: the corners of what the two share.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends to the contacts of a mesh (A) and a convex body (B), for each triangle that lies nearly along a
/// face of B (Convex::faces), the corners of what face and triangle share, seen along the contact's normal:
/// those no farther apart than `threshold`. Looks at the first `of_triangles` contacts. Contacts are in the
/// mesh's frame. Where `contacts` has the room, allocates nothing.
void addFlatContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                     double threshold, std::size_t of_triangles, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
