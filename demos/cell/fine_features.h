// The fine features of a solid: its sharp edges, its thin walls, and whatever is rounder than a given depth.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// Triangles of a mesh, with a tree of their own.
struct FineFeatures {
  std::shared_ptr<const ClusteredOctree> tree;  ///< null where there are none
  std::vector<std::uint32_t> triangles;  ///< of each triangle of the tree: its number in the whole mesh
};

/// The triangles of a closed surface that faces outward, where a point a given depth inwards along the normal
/// is nearer to the surface than 96 % of it: asked at corners, middles of edges and centroid. Where the
/// surface is not oriented, all triangles.
///
/// What they are for: let no point of another solid's surface be deeper in this solid than `depth`, and let
/// it not swallow the whole. Then the other solid has no point at all that is deeper, and a point of this
/// surface that is deeper in the other than `depth` is where no ball of that radius touches it from within:
/// on a fine feature. (Edges that turn by 16° or less are none: cos 16° = 0.96, and across such an edge
/// either depth may exceed the other by 1 − cos 8° = 1 %.)
FineFeatures fineFeatures(const octoblisk::Surface& surface, double depth, int threads = 0);

}  // namespace octoblisk::demos
