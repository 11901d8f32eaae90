#include "octoblisk/leaf_vertices.h"

namespace octoblisk {

void writeLeafVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const Obb& frame,
                       float* rows) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const TriangleMesh::Indices& corners = mesh.triangles()[triangles[i]];
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3 corner = frame.axes.transpose() * (mesh.vertices()[corners[v]] - frame.center);
      for (std::size_t k = 0; k < 3; ++k) {
        rows[(3 * v + k) * triangles.size() + i] = static_cast<float>(corner[static_cast<Eigen::Index>(k)]);
      }
    }
  }
}

}  // namespace octoblisk
