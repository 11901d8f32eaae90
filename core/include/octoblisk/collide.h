// Whether two bodies touch, and which triangles meet.
#pragma once

#include <optional>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/contact.h"
#include "octoblisk/convex.h"

namespace octoblisk {

/// A pair of triangles that meet, or none if the two meshes do not touch. B's vertices are posed in double
/// precision; the verdict then equals exact arithmetic on all triangle pairs. Treats meshes as surfaces, not
/// as solids: a mesh wholly inside another does not touch it. Allocates nothing.
std::optional<TrianglePair> collide(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a);

/// Replaces `found` with all pairs of triangles that meet, in ascending order of indices. Allocates nothing
/// if the capacity of `found` suffices.
void touchingPairs(const ClusteredOctree& a, const ClusteredOctree& b, const Pose& b_in_a,
                   std::vector<TrianglePair>& found);

/// A triangle of A that meets the convex body B, or none. Allocates nothing.
std::optional<std::uint32_t> collide(const ClusteredOctree& a, const Convex& b, const Pose& b_in_a);

}  // namespace octoblisk
