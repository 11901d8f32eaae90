// A mesh on, or in, a half-space.
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

/// Replaces `found` by a contact for every vertex in use no farther than `threshold` (>= 0) from the
/// half-space B, which is given in A's frame: each vertex once (two at one place are two), with the first
/// triangle that uses it, by ascending triangles. The normal is the half-space's; the distance is the
/// vertex's height, below 0 inside however deep. Where `found` has the room, allocates nothing.
void contacts(const ClusteredOctree& a, const HalfSpace& b_in_a, double threshold,
              std::vector<Contact>& found);

}  // namespace octoblisk
