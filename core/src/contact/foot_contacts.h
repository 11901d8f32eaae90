// Contacts for all feet of a convex body that stands on a triangle, not only for its deepest point.
#pragma once

#include <span>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/function_ref.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::detail {

/// Points of a convex body's core, e.g. the corners of a box, the ends of a capsule or points on the rim of a
/// cylinder, on which the body may stand if it is pushed along a unit vector `towards`; both in its frame.
using FindFeet = FunctionRef<std::span<const Vec3>(const Vec3& towards)>;

/// Appends contacts for the feet of a convex body (B) to the contacts of a mesh (A) and B. A foot gets a
/// contact if it is over or in the triangle of one of the contacts, no farther from it than `threshold`, and
/// no deeper than the deepest contact. Uses the first `of_triangles` contacts. Contacts are in the mesh's
/// frame. Allocates nothing if the capacity of `contacts` suffices.
void addFootContacts(const TriangleMesh& mesh, FindFeet feet, double radius, const Pose& convex_in_mesh,
                     double threshold, std::size_t of_triangles, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
