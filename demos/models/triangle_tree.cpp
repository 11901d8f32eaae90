#include "models/triangle_tree.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "models/shared_tree.h"

namespace octoblisk::demos {

std::shared_ptr<const ClusteredOctree> treeOfTriangles(const TriangleMesh& mesh,
                                                       std::vector<TriangleMesh::Indices> triangles) {
  constexpr auto kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> renumbered(mesh.vertices().size(), kUnused);
  std::vector<Vec3> vertices;
  for (TriangleMesh::Indices& corners : triangles) {
    for (std::uint32_t& corner : corners) {
      if (renumbered[corner] == kUnused) {
        renumbered[corner] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(mesh.vertices()[corner]);
      }
      corner = renumbered[corner];
    }
  }
  return treeOf(TriangleMesh(std::move(vertices), std::move(triangles)));
}

}  // namespace octoblisk::demos
