// What the contacts of two bodies must satisfy, by brute force over their triangles.
#pragma once

#include <string>
#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// Returns a message if contacts are not those of two surfaces within a threshold, in A's frame; an empty
/// string if they are:
/// - There are contacts exactly if triangles are within the threshold, or hardly farther apart.
/// - Apart, no contact is nearer than 0.99 times the nearest points, and one is as near up to `not_felt`.
/// - Both points of a contact that does not overlap are on the contact's triangles, or beside them by no more
///   than a tenth of its distance. If triangles meet, one at a distance of 0 may be in the middle of a curve.
/// - If triangles meet, a contact touches.
/// All up to `noise`. A contact at the end of the threshold, up to noise, may be missing.
std::string faultOfContacts(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                            double threshold, double not_felt, double noise,
                            const std::vector<Contact>& found);

}  // namespace octoblisk::testing
