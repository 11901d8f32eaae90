// The fine features of a solid: its sharp edges, its thin walls, and whatever is rounder than a given depth.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "octoblisk/clustered_octree.h"
#include "octoblisk/solid_boundary.h"
#include "octoblisk/surface.h"

namespace octoblisk::demos {

/// The numbers of the triangles that bound no solid, and of those of the rest, which faces outward, where a
/// point a given depth inwards along the normal is nearer to the surface than 96 % of it: asked at corners,
/// middles of edges and centroid.
///
/// What they are for: let no point of another solid's surface be deeper in this solid than `depth`, and let
/// it not swallow the whole. Then the other solid has no point at all that is deeper, and a point of this
/// surface that is deeper in the other than `depth` is where no ball of that radius touches it from within:
/// on a fine feature. (Edges that turn by 16° or less are none: cos 16° = 0.96, and across such an edge
/// either depth may exceed the other by 1 - cos 8° = 1 %.)
std::vector<std::uint32_t> fineFeatures(const SolidBoundary& boundary, double depth, int threads = 0);

/// A point of some triangles that lies inside a solid.
struct DeepPoint {
  double depth = 0.0;         ///< its distance to the solid's surface
  Vec3 point = Vec3::Zero();  ///< in the frame of the triangles
  std::uint32_t triangle = 0;
};

/// A point of some triangles of a mesh that lies deeper inside a closed solid than the limit (> 0); no other
/// is deeper by more than a tenth. None where no point exceeds the limit, and at times where none does so by
/// more than a twentieth: to tell closer takes long. By division of the triangles into quarters, until none
/// may be that deep: the distance to a surface grows by no more than the way.
std::optional<DeepPoint> deepestBeyond(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                                       const octoblisk::Surface& solid, const Pose& mesh_in_solid,
                                       double limit);

}  // namespace octoblisk::demos
