// Meshes as bad as files have them: slivers, duplicates, T-junctions, open edges, tiny, huge, far away.
#pragma once

#include "shared/meshes.h"

namespace octoblisk::testing {

enum class MeshKind {
  solid,       ///< closed, with bumps
  slivers,     ///< thin as rounding, side by side in a sheet and across each other
  duplicates,  ///< triangles twice and thrice, in part turned over, in part with corners of their own
  tJunctions,  ///< vertices amid the edges of other triangles
  openEdges,   ///< with holes
  soup,        ///< nothing joined; segments and points among the triangles
};
inline constexpr int kMeshKinds = 6;
const char* nameOf(MeshKind kind);

/// About the origin, within 1.5 of it, of at most 120 triangles.
SharedMesh hardMesh(std::mt19937_64& random, MeshKind kind);

/// Every vertex times the scale, and moved by the offset after it.
SharedMesh placed(const TriangleMesh& mesh, double scale, const Vec3& offset);

}  // namespace octoblisk::testing
