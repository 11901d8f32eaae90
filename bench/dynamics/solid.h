// A solid of uniform density. A body is measured by its solid, whatever shape Bullet uses.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/surface.h"
#include "shapes/bodies.h"

namespace octoblisk::bench {

/// The convex parts of a solid: the indices of each part's vertices in the mesh.
using Pieces = std::vector<std::vector<std::uint32_t>>;

/// `count` runs of eight vertices. Each run starts `stride` after the previous one.
Pieces piecesOfEight(std::size_t count, std::uint32_t first, std::uint32_t stride);

/// Moves the solid so that its centre of mass is the origin and its principal axes are the coordinate axes,
/// as Bullet's diagonal inertia requires. Returns the same mesh if it is already so.
shapes::SharedMesh inPrincipalFrame(const shapes::SharedMesh& mesh);

struct Solid {
  /// The mesh must be closed.
  explicit Solid(shapes::SharedMesh closed, Pieces convex_pieces = {});
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;

  shapes::SharedMesh mesh;
  Pieces pieces;  ///< empty: unknown
  Vec3 moments;   ///< of inertia about the axes, for mass 1
  ClusteredOctree tree;
  Surface surface;
};

}  // namespace octoblisk::bench
