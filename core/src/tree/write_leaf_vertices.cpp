#include "tree/write_leaf_vertices.h"

#include "base/huge_pages.h"
#include "tree/for_each_node.h"
#include "tree/leaf_vertices.h"

namespace octoblisk::detail {

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
