// Contacts for a face of a convex body that lies flat on a triangle: the corners of their common area.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends contacts to those of a mesh (A) and a convex body (B). If a contact is nearly perpendicular to its
/// triangle, and a face of B (Convex::faces) nearly parallel to it, these are the corners of the area that
/// face and triangle share. At a corner of the triangle, the face pushes along its normal, because a rough
/// mesh stands on such corners; none is added where the contact itself is. At other corners, the triangle
/// pushes along its own normal. A corner that is deeper than the contact takes its normal and distance. Only
/// corners where the two are no farther apart than `threshold` count. Contacts are in the mesh's frame.
/// Allocates nothing if the capacity of `contacts` suffices.
void addFlatContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                     double threshold, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
