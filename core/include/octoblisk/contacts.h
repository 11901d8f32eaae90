// All contacts between two bodies, including near misses.
#pragma once

#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_cache.h"

namespace octoblisk {

/// Replaces `found` with the contact of every triangle pair no farther apart than `threshold` (>= 0, mesh
/// units), in ascending order of indices. Points and normals are in A's frame. Allocates nothing if the
/// capacity of `found` suffices. A contact ignores the neighbours of its triangles. On a coarse mesh, a
/// contact of bodies that barely meet may be as deep as a triangle is wide. The plugin leaves such contacts
/// out.
void contacts(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found);

/// The same for the triangles of A and the convex body B.
void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found);

/// The same, and faster if the body has moved little since the last query with the same `near`.
void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              TriangleCache& near, std::vector<Contact>& found);

}  // namespace octoblisk
