// A mesh as it is drawn: of so many triangles at most, in groups of one colour.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

struct DisplayMesh {
  /// Triangles of one group, one after another.
  struct Group {
    int number = 0;
    std::size_t first = 0, count = 0;
  };

  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<Group> groups;  ///< ascending
  /// The side of the cubes within which vertices were merged, in the mesh's units; 0: it is the whole mesh.
  double merged_within = 0.0;
};

/// The mesh with its triangles by groups (`group_of_triangle`, or one group 0 where that is empty), thinned
/// where it has more triangles than `most`: vertices in the same cube of a grid that face the same way become
/// one of them (vertex clustering; Rossignac and Borrel 1993), so the two sides of a thin wall stay apart.
/// For looking at only: thin things and small holes may change.
/// Throws std::invalid_argument where there are not as many groups as triangles, or `most` is 0.
DisplayMesh displayMeshOf(const TriangleMesh& mesh, std::span<const int> group_of_triangle, std::size_t most);

}  // namespace octoblisk::demos
