#include "tree/write_leaf_vertices.h"

#include "base/huge_pages.h"
#include "tree/for_each_node.h"
#include "tree/leaf_vertices.h"

namespace octoblisk::detail {

void writeAllLeafVertices(OwnedArrays& tree, const TriangleMesh& mesh, const Vec3& origin, int threads) {
  if (tree.leaf_vertices.empty()) {
    reserveOnHugePages(tree.leaf_vertices, 9 * tree.triangle_order.size() + kLanes);
    tree.leaf_vertices.resize(9 * tree.triangle_order.size() + kLanes);
  }
  const TreeArrays arrays = tree.view();
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
