// Meshes with the defects of real files: slivers, duplicates, T-junctions, open edges, tiny, huge, far away.
#pragma once

#include "shared/meshes.h"

namespace octoblisk::testing {

enum class MeshKind {
  solid,       ///< closed, with bumps
  slivers,     ///< thin as rounding, side by side in a sheet and across each other
  duplicates,  ///< triangles two or three times, some reversed, some with their own vertices
  tJunctions,  ///< vertices on the edges of other triangles
  openEdges,   ///< with holes
  soup,        ///< unconnected, with segments and points among the triangles
};
inline constexpr int kMeshKinds = 6;
const char* nameOf(MeshKind kind);

/// A mesh of at most 120 triangles within 1.5 of the origin.
SharedMesh hardMesh(std::mt19937_64& random, MeshKind kind);

}  // namespace octoblisk::testing
