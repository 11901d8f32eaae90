// Simplifies a mesh for display to a limited number of triangles, in groups of one colour.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "octoblisk/triangle_mesh.h"

namespace octoblisk::demos {

struct DisplayMesh {
  /// Consecutive triangles of one group.
  struct Group {
    int number = 0;
    std::size_t first = 0, count = 0;
  };

  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Indices> triangles;
  std::vector<Group> groups;  ///< ascending
  bool is_simplified = false;
  double error = 0.0;  ///< estimated greatest distance from the whole mesh, in the mesh's units
};

/// The mesh with its triangles sorted by group (`group_of_triangle`, or one group 0 if that is empty). A mesh
/// of more than `most` triangles is simplified by quadric error metrics (M. Garland, P. S. Heckbert, Surface
/// simplification using quadric error metrics, 1997), each group on its own with its borders kept. If the
/// borders alone are too many, triangles are dropped. For display only.
/// Throws std::invalid_argument if the number of groups differs from that of the triangles, or `most` is 0.
DisplayMesh displayMeshOf(const TriangleMesh& mesh, std::span<const int> group_of_triangle, std::size_t most);

}  // namespace octoblisk::demos
