// Oracles: the answers by looking at every triangle.
#pragma once

#include <vector>

#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_mesh.h"

namespace octoblisk::testing {

/// All pairs of triangles that meet, by ascending indices.
std::vector<TrianglePair> bruteForcePairs(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a);

/// The contacts of all pairs of triangles no farther apart than the threshold, by ascending indices.
std::vector<Contact> bruteForceContacts(const TriangleMesh& a, const TriangleMesh& b, const Pose& b_in_a,
                                        double threshold);

/// The distance of the deepest, or nearest, of some contacts.
double deepest(const std::vector<Contact>& contacts);

/// The exact verdict on two triangles with integer corners, |coordinate| <= 1024: separating axes in
/// integers. Shares no step with the library's test.
bool integerTrianglesMeet(const Triangle& a, const Triangle& b);

/// How far a box must move along the best of the thirteen axes of a triangle and a box to part from it: the
/// depth where above 0; where not, they are apart.
double boxTriangleOverlap(const Obb& box, const Triangle& triangle);

}  // namespace octoblisk::testing
