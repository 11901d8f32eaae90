// All contacts between two bodies up to a distance.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

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

/// The same, but only for the given triangles of A. A TriangleCache (triangle_cache.h) finds those near a
/// body that moves little.
void contacts(const ClusteredOctree& a, std::span<const std::uint32_t> triangles_of_a, const Convex& b,
              const Pose& b_in_a, double threshold, std::vector<Contact>& found);

}  // namespace octoblisk
