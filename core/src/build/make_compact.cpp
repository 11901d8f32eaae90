#include "build/make_compact.h"

#include <utility>

#include "tree/for_each_node.h"
#include "tree/refit.h"

namespace octoblisk::detail {

void makeCompact(OwnedArrays& tree, const TriangleMesh& mesh, int threads) {
  std::vector<CompactNode> compact_nodes(tree.nodes.size());
  forEachNode(tree.view(), threads, [&](std::uint32_t n) {
    CompactNode& node = compact_nodes[n];
    node.children = tree.nodes[n].children;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (node.children[lane].isEmpty()) continue;
      const CompactRotation rotation = compactRotation(tree.nodes[n].boxes.get(lane).axes);
      for (std::size_t k = 0; k < 4; ++k) node.rotation[k][lane] = rotation[k];
    }
  });
  tree.nodes = std::vector<TreeNode>();  // frees the memory, which = {} would not
  tree.compact_nodes = std::move(compact_nodes);
  refit(tree, mesh, threads);
}

}  // namespace octoblisk::detail
