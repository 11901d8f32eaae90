#include "tree/leaf_vertices.h"

#include "base/huge_pages.h"
#include "tree/for_each_node.h"

namespace octoblisk::detail {

void writeLeafVertices(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles, const BoxF& box,
                       const Vec3& origin, float* rows) {
  double axes[3][3], center[3];  // plain numbers, which the compiler keeps in registers
  for (int k = 0; k < 3; ++k) {
    center[k] = double(box.center[k]);
    for (int j = 0; j < 3; ++j) axes[k][j] = double(box.axes(k, j));
  }
  const std::size_t count = triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleMesh::Indices& corners = mesh.triangles()[triangles[i]];
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3& corner = mesh.vertices()[corners[v]];
      const double x = corner[0] - origin[0] - center[0], y = corner[1] - origin[1] - center[1],
                   z = corner[2] - origin[2] - center[2];
      for (std::size_t k = 0; k < 3; ++k)
        rows[(3 * v + k) * count + i] = static_cast<float>(axes[0][k] * x + axes[1][k] * y + axes[2][k] * z);
    }
  }
}

void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, int threads) {
  if (tree.leaf_vertices.empty()) {
    const std::size_t size = leafVerticesSize(tree.triangle_order.size());
    reserveOnHugePages(tree.leaf_vertices, size);
    tree.leaf_vertices.resize(size);
  }
  const TreeArrays arrays = tree.view();
  const Vec3 origin = mesh.bounds().center();
  forEachNode(arrays, threads, [&](std::uint32_t n) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Child leaf = arrays.children(n)[lane];
      if (!leaf.isLeaf()) continue;
      writeLeafVertices(mesh, arrays.triangles(leaf), arrays.box({n, lane}), origin,
                        tree.leaf_vertices.data() + 9 * std::size_t{leaf.first()});
    }
  });
}

}  // namespace octoblisk::detail
