// Where a convex body stands on a triangle: on all its feet over it, not on the deepest point alone.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Appends to the contacts of a mesh (A) and a convex body (B) those of the body's feet: points of its core,
/// for instance the corners of a box, the ends of a capsule or points on the rim of a cylinder. A foot is
/// over, or in, the triangle of one of the contacts, no farther from it than `threshold` and no deeper than
/// the deepest contact. Looks at the first `of_triangles` contacts. Contacts are in the mesh's frame. Where
/// `contacts` has the room, allocates nothing.
void addCornerContacts(const TriangleMesh& mesh, std::span<const Vec3> feet, double radius,
                       const Pose& convex_in_mesh, double threshold, std::size_t of_triangles,
                       std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
