// A solid of even density: what is measured of a body, whatever shape Bullet is given.
#pragma once

#include <cstdint>
#include <vector>

#include "octoblisk/surface.h"
#include "shapes/bodies.h"

namespace octoblisk::bench {

/// Convex parts that make up a solid: the vertices of each, by their index in the mesh.
using Pieces = std::vector<std::vector<std::uint32_t>>;

/// So many runs of eight vertices, each `stride` after the one before.
Pieces piecesOfEight(std::size_t count, std::uint32_t first, std::uint32_t stride);

/// The solid moved so that its centre of mass is the origin and its principal axes are the coordinate axes,
/// as Bullet's diagonal inertia wants it; as it is where that is so.
shapes::SharedMesh inPrincipalFrame(const shapes::SharedMesh& mesh);

struct Solid {
  /// Of a closed mesh.
  explicit Solid(shapes::SharedMesh closed, Pieces convex_pieces = {});
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;

  shapes::SharedMesh mesh;
  Pieces pieces;  ///< none: not known
  Vec3 moments;   ///< of inertia about the axes, of mass 1
  ClusteredOctree tree;
  Surface surface;
};

}  // namespace octoblisk::bench
