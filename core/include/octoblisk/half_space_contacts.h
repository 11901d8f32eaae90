// Contacts between a mesh and a half-space.
#pragma once

#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"

namespace octoblisk {

/// The points x with normal · x <= offset.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();  ///< unit, outward
  double offset = 0.0;          ///< mesh units
};

/// Replaces `found` with a contact for every vertex that a triangle uses and that is no farther than
/// `threshold` (>= 0, mesh units) from the half-space B. B is given in A's frame. Each vertex counts once;
/// two vertices at one position count twice. A contact names the first triangle that uses its vertex;
/// contacts are in ascending order of triangles. The normal is that of the half-space. The distance is the
/// height of the vertex, negative inside at any depth. Allocates nothing if the capacity of `found` suffices.
void contacts(const ClusteredOctree& a, const HalfSpace& b_in_a, double threshold,
              std::vector<Contact>& found);

}  // namespace octoblisk
