// All contacts of two bodies, near misses included.
#pragma once

#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"
#include "octoblisk/triangle_cache.h"

namespace octoblisk {

/// Replaces `found` by the contact of every pair of triangles no farther apart than `threshold` (>= 0), by
/// ascending indices. Points and normals are in A's frame. Where `found` has the room, allocates nothing.
/// A pair knows nothing of the triangles beside it: where bodies hardly meet, one of a coarse mesh may be as
/// deep as a triangle is wide (SurfaceContacts leaves these out).
void contacts(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found);

/// The same for every triangle of A and the convex body B.
void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              std::vector<Contact>& found);

/// The same, faster, of a body that has moved little since it was asked about with the same `near`.
void contacts(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a, double threshold,
              TriangleCache& near, std::vector<Contact>& found);

}  // namespace octoblisk
