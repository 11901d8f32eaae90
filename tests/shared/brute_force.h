// Oracles: answers by brute force over every triangle.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// All triangle pairs that meet, in ascending order of indices.
std::vector<TrianglePair> bruteForcePairs(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a);

/// The least distance of all triangle pairs, if none meets.
double bruteForceDistance(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a);

/// The contacts of all triangle pairs no farther apart than the threshold, in ascending order of indices.
std::vector<Contact> bruteForceContacts(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                                        double threshold);

/// The least distance of some contacts.
double deepest(const std::vector<Contact>& contacts);

/// The exact verdict on two triangles with integer corners, |coordinate| <= 1024: separating axes in
/// integers. Shares no step with the library's test.
bool integerTrianglesMeet(const Triangle& a, const Triangle& b);

/// The distance that a box must move along the best of the thirteen separating axes to leave a triangle. If
/// it is above 0, it is the depth; otherwise the two are apart.
double boxTriangleOverlap(const Obb& box, const Triangle& triangle);

}  // namespace octoblisk::testing
