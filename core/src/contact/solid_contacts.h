// Contacts of a convex body with a solid.
#pragma once

#include <vector>

#include "contact/point_in_solid.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

namespace octoblisk::detail {

/// Converts contacts between the boundary of a solid (A) and a convex body (B) to contacts with the solid A.
/// Triangles do not know which of their sides is solid, and push B out of the nearer one.
/// - If B's middle is inside A, B leaves through the point of the surface that is closest to the middle. This
///   contact is added, and the contacts that push against it are removed.
/// - If B's middle is outside A and an end of its core is inside, the closest point of the surface to the end
///   gets a contact as well, if that way out leads to the middle. It is as deep as the end and the radius
///   around it.
/// - If B's middle is outside A, contacts that would push B through the solid are removed, if others touch. A
///   contact does so if the middle is behind its plane by no more than the contact's depth.
/// All triangles within `reach` of B have contacts.
void toSolidContacts(const SolidMesh& solid, const Convex& convex, const Pose& convex_in_mesh, double reach,
                     PointInSolid& middle, std::vector<Contact>& contacts);

}  // namespace octoblisk::detail
