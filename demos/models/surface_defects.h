// Finds the defects that keep a surface from bounding a solid: open edges, non-manifold edges, duplicate
// triangles.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

struct FaultyEdges {
  std::size_t count = 0;
  std::array<Vec3, 2> first = {Vec3::Zero(), Vec3::Zero()};  ///< of the lowest triangle with such an edge
};

struct SurfaceDefects {
  FaultyEdges open = {};          ///< edges of one triangle
  FaultyEdges non_manifold = {};  ///< edges of more than two triangles
  std::size_t duplicates = 0;     ///< triangles with the same three corners as a lower one
  std::size_t first_duplicate = 0;
  /// Every edge has an even number of triangles, which octoblisk::Surface calls closed.
  bool is_closed = true;

  bool none() const { return open.count + non_manifold.count + duplicates == 0; }
};

/// Vertices at equal coordinates count as one.
SurfaceDefects defectsOf(const TriangleMesh& mesh);

/// "3 of its edges are open, the first from (0 0 1) to (0 1 1); 1 of its edges is non-manifold, from …; 2 of
/// its triangles are duplicates, the first number 7": only those of the three that occur.
std::string describe(const SurfaceDefects& defects);

}  // namespace octoblisk::demos
