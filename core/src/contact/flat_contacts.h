// Contacts for a face of a convex body that lies flat on a triangle: the corners of their common area.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Completes the contacts of a mesh (A) and a convex body (B) where a face of B (Convex::faces) lies flat on
/// a triangle: if the triangle's contact is nearly perpendicular to both. The face and the triangle then
/// share an area. Appends a contact at each of its corners where the two are no farther apart than
/// `threshold`, except where the triangle's contact already is. At a corner of the triangle, the face pushes
/// along its normal, because a rough mesh stands on such corners. At other corners, the triangle pushes along
/// its own normal. A corner that is deeper than the triangle's contact takes its normal and distance.
/// Contacts are in the mesh's frame. Allocates nothing if the capacity of `contacts` suffices.
void addFlatContacts(const TriangleMesh& mesh, const Convex& convex, const Pose& convex_in_mesh,
                     double threshold, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
